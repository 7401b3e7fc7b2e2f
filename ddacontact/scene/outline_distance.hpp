/// \file How far outlines are from each other.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact::scene_format {

/// From a point to the nearest one of the edge from `start` to `end`, m.
double distance_to_edge(const Vec2& point, const Vec2& start, const Vec2& end);

/// From a point to the nearest one of an outline, m; also from inside.
double distance_to_outline(const Vec2& point, const PointsRef& polygon);

/// Between two simple polygons, concave ones too, m; 0 when they have a point in common.
double distance_between(const PointsRef& a, const PointsRef& b);

}  // namespace ddacontact::scene_format
