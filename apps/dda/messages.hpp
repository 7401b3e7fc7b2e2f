/// \file What the program tells on stderr.
#pragma once

#include <ddacontact/scene/reader.hpp>

#include <string>

namespace dda {

/// `dda: error: TEXT`
void print_error(const std::string& text);

/// Prints every problem of a reading, a line each, and returns the exit status it means.
int report(const ddacontact::SceneReading& reading);

}  // namespace dda
