/// \file A hexagon that rolls down a slope, edge after edge.
#pragma once

#include "mechanics_scenes.hpp"

namespace verification {

constexpr double tumbling_time = 1.6;  ///< s: four edges

/// A regular hexagon of side 0.5 m on a slope of 35 degrees, steeper than the 30 it stands on, and rough
/// enough not to slide.
Scene tumbling_scene(Scheme scheme, double time_step);

/// The centroid's travel by the decaying scheme at a step of 5e-5 s.
const Vec2& converged_tumble();

}  // namespace verification
