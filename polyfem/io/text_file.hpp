/// \file A whole file in memory.
#pragma once

#include <filesystem>
#include <string>

namespace polyfem {

/// The bytes of a file. Throws FileError, which names it and says why it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace polyfem
