/// \file Which of two methods is more accurate at equal run time.
#pragma once

#include <tests/performance/error_time/measurement.hpp>

#include <optional>

namespace error_time {

/// What a method buys with time in one quantity: runs by rising time, each more accurate than all before it.
/// Runs that did not end count as an error of 1, and so do larger errors.
struct Frontier {
  std::vector<double> seconds, errors;

  bool empty() const { return seconds.empty(); }
  /// Between runs by logarithms, after the last its error. Not defined before the first.
  double error_at(double time) const;
};
Frontier frontier(const std::vector<Measurement>& all, const std::string& quantity,
                  const std::string& method);

/// The other method's error over this one's at equal run time, over all times from where both have runs to
/// where neither gets better: > 1 where this one is ahead.
struct Lead {
  double least, least_at;  ///< and where, s
  double most, most_at;
};
std::optional<Lead> lead_of(const Frontier& one, const Frontier& other);

}  // namespace error_time
