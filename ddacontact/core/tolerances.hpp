/// \file Numbers below which differences do not count.
#pragma once

#include <limits>

namespace ddacontact {

/// Of the size of the smaller block: two positions nearer than this are one, and what is nearer touches.
inline constexpr double coincidence = 1e-6;
/// Of the penetration tolerance, and of what coincides: gaps that tell nothing. They stay uncorrected: in a
/// wall every correction moves neighbours, for hundreds of steps.
inline constexpr double negligible_gap = 1e-3;
/// Of a block's size: lengths below this are round-off.
inline constexpr double length_round_off = 1e-12;
/// Of a sum's terms: a few units in the last place.
inline constexpr double few_ulps = 8 * std::numeric_limits<double>::epsilon();

}  // namespace ddacontact
