/// \file The factor of safety of a random slope by strength reduction, against limit analysis.
#pragma once

#include "slope_study.hpp"

#include <ddacontact/study/variant_trials.hpp>

namespace jointed_rock {

constexpr double known_factor = 1.2;  ///< of limit analysis, if corners pass each other
/// Of the factors.
constexpr double most_above = 1.01, least_on_a_plane = 0.97;

/// The slope with the friction that gives `known_factor`, settled.
StrengthReduction reduction_of(const Slope& slope);

struct SlopeFactor {
  FactorBracket found;  ///< over `known_factor`
  double interlocked =
      0;  ///< the factor of limit analysis where no corner passes a corner, over the other one
  bool on_a_plane = false;  ///< what moves first slides along one plane, which has the limiting dip

  bool never_above() const { return found.low <= most_above * interlocked; }
  bool close_on_a_plane() const {
    return found.low >= least_on_a_plane && found.high <= 2 - least_on_a_plane;
  }
};

/// \param[in] tolerance  of the bracket, relative
SlopeFactor factor_of(const Slope& slope, double tolerance);

/// That with rounded corners with which `dda safety` ends.
StrengthTrial rounded_trial(const Slope& slope, const SlopeFactor& factor);

/// Over `Slope::limit`: largest factor at which any admissible forces exist, see support::interlocked.
double interlocked_factor(const Slope& slope);

/// Whether some face has the dip tan^-1(limit) and the blocks that moved went along it, none of their
/// vertices more than a tenth of the way aside.
bool slid_on_a_plane(const Slope& slope, const StrengthTrial& trial);

}  // namespace jointed_rock
