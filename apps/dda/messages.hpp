/// \file What the program tells on stderr.
#pragma once

#include <ddacontact/scene/reader.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace dda {

/// `dda: error: TEXT`
void print_error(const std::string& text);

/// Says on stdout where an older file is now, if it was kept.
void tell_of_older(const std::string& file, const std::optional<std::filesystem::path>& kept);

/// Prints every problem of a reading, a line each, and returns the exit status it means.
int report(const ddacontact::SceneReading& reading);

}  // namespace dda
