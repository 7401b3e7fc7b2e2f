/// \file `dda info`: a result in words.
#pragma once

#include <string>

namespace dda {

/// Prints the summary of a result directory and returns the exit status.
int info(const std::string& directory);

}  // namespace dda
