/// \file How far apart two polygons are, or how deep they overlap.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// Separation of two polygons, m: >= 0 when they do not overlap, else minus the depth by which they do. For
/// convex polygons it is the largest gap over all edges of either between the edge's line and the other
/// polygon; for others the least over the convex pieces that they are cut into. The sign is exact: < 0 if and
/// only if the polygons have more in common than boundary. Polygons are simple and counter-clockwise. Throws
/// Error when one that is not has to be cut.
double separation(const polyfem::PointsRef& a, const polyfem::PointsRef& b);

}  // namespace ddacontact
