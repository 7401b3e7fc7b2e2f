/// \file How far apart two convex polygons are along their best separating edge.
#pragma once

#include <polyfem/core/types.hpp>

namespace ddacontact {

/// The largest gap over all edges of either polygon between the edge's line and the other polygon: >= 0 when
/// they do not overlap, else minus the depth by which they do. Strictly convex, counter-clockwise polygons.
double separation(const polyfem::PointsRef& a, const polyfem::PointsRef& b);

}  // namespace ddacontact
