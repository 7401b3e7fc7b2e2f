/// \file What many factors of safety say together: mean, spread, probability of failure.
#pragma once

#include <string>
#include <vector>

namespace ddacontact {

/// Of cases of the same weight.
struct FactorDistribution {
  std::vector<double> factors;  ///< ascending; those that were bracketed
  int n_always = 0;             ///< cases that move at every factor that was tried, 1 or less among them
  int n_never = 0;              ///< cases that rest at every factor, 1 or more among them
  /// Cases that move, or rest, at every factor that has a verdict, all of these on the other side of 1.
  int n_move_above = 0, n_rest_below = 0;
  int n_unknown = 0;  ///< beside these: cases that ended without a factor

  int n_cases() const { return static_cast<int>(factors.size()) + n_always + n_never + n_undecided(); }
  int n_undecided() const { return n_move_above + n_rest_below; }
  /// Of the factors, of which there is one at least; the deviation is that of the sample (n - 1), 0 for one.
  double mean() const;
  double median() const;
  double standard_deviation() const;
  /// Cases whose factor is below 1, as a part of all, and its standard error sqrt(p (1 - p) / n), where none is
  /// undecided.
  double probability_of_failure() const;
  double standard_error() const;
  int n_failing() const;
};

/// The middles of brackets, from two columns of sweep.csv: the largest factor at which a case rests, and the
/// smallest at which it moves. Where one is empty it moves, or rests, at every factor; where both are it ended
/// without one.
FactorDistribution distribution_of(const std::vector<std::string>& low, const std::vector<std::string>& high);

/// In sentences, with a histogram, for a terminal.
std::string describe(const FactorDistribution& distribution);

/// Cases with a factor below F, as a part of all, over F, but for the largest 2.5 % of the factors: SVG.
/// Throws Error when there is no factor.
std::string draw(const FactorDistribution& distribution);

}  // namespace ddacontact
