/// \file What is told of a block at the end: place, shape, motion, stress.
#pragma once

#include <ddacontact/block/block.hpp>

namespace ddacontact {

/// Mean and extreme stresses of a block.
struct StressRange {
  Vec3 mean, min, max;  ///< (xx, yy, xy): area average and extremes over the integration points, Pa
  double s1_max = 0;    ///< largest principal stress at an integration point
  double s2_min = 0;    ///< smallest
};

/// The area average of StressRange alone.
Vec3 mean_stress(const Block& block, const BlockState& state);

/// At the integration points.
StressRange stress_range(const Block& block, const BlockState& state);

}  // namespace ddacontact
