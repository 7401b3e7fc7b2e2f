/// \file How far outlines are from each other.
#pragma once

#include <ddacontact/detection/corner_clearance.hpp>

namespace ddacontact::scene_format {

using ddacontact::distance_to_edge;
using ddacontact::distance_to_outline;

/// Between two simple polygons, concave ones too, m; 0 when they have a point in common.
double distance_between(const PointsRef& a, const PointsRef& b);

}  // namespace ddacontact::scene_format
