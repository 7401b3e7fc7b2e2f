/// \file One thing that is wrong with an input file, with its place and its cure.
#pragma once

#include <string>
#include <vector>

namespace ddacontact {

/// An error or a warning and where it stands.
struct Problem {
  enum class Severity { error, warning };
  Severity severity = Severity::error;
  std::string file;
  int line = 1, column = 1;
  std::string what;  ///< quotes the offending word
  std::string cure;  ///< what to write instead; may be empty

  /// `FILE:LINE:COL: error: WHAT (CURE)`
  std::string text() const;
};

/// Whether one of them is more than a warning.
bool has_errors(const std::vector<Problem>& problems);

}  // namespace ddacontact
