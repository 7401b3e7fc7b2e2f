/// \file The exception of what does not fit into memory.
#pragma once

#include <new>
#include <stdexcept>
#include <string>

namespace polyfem {

/// What is requested does not fit into memory, or its entries cannot be counted; the message says what.
class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(const std::string& message) : message_(message) {}
  const char* what() const noexcept override { return message_.what(); }

 private:
  std::runtime_error message_;  ///< its copies do not throw
};

}  // namespace polyfem
