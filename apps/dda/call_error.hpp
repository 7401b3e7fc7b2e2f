/// \file Thrown when a call of the program is wrong.
#pragma once

#include <stdexcept>

namespace dda {

/// Ends the program with `wrong_input`.
class CallError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dda
