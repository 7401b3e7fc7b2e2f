/// \file Why a file could not be written.
#pragma once

#include <polyfem/core/error.hpp>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace polyfem {

/// Names the file and what the system said last, in errno: to be called before anything else may fail.
inline FileError write_error(const std::filesystem::path& path) {
  const int reason = errno != 0 ? errno : EIO;
  return FileError("cannot write \"" + path.string() + "\": " + std::generic_category().message(reason));
}

}  // namespace polyfem
