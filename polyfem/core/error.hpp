/// \file The exceptions of both libraries.
#pragma once

#include <stdexcept>

namespace polyfem {

/// Thrown for what the caller must mend: the message names the cause and the cure.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file cannot be read or written; the message names it.
class FileError : public Error {
 public:
  using Error::Error;
};

}  // namespace polyfem
