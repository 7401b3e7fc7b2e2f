/// \file Thrown when a call of the program is wrong.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dda {

/// Ends the program with `wrong_input`.
class CallError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The cure for a word that is not among the known ones: the nearest, and the list of all.
std::string choice_among(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace dda
