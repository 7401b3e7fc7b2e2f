/// \file How far apart two polygons are, or how deep they overlap.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// Of convex polygons the largest gap over all edges of either between the edge's line and the other polygon:
/// >= 0 when they do not overlap, else minus the depth by which they do. Of others the least of that over the
/// convex pieces they are cut into. Simple, counter-clockwise polygons; throws Error else, where a polygon
/// has to be cut. The sign is exact: < 0 if and only if the polygons have more in common than boundary.
double separation(const polyfem::PointsRef& a, const polyfem::PointsRef& b);

}  // namespace ddacontact
