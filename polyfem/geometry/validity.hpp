/// \file What may be wrong with a polygon, found by exact predicates.
#pragma once

#include <polyfem/core/types.hpp>

#include <optional>

namespace polyfem {

/// What may be wrong with a polygon.
enum class PolygonDefect { too_few_vertices, not_finite, repeated_vertex, zero_area, self_intersection };

/// A defect and where it shows.
struct DefectiveVertex {
  PolygonDefect defect;
  int vertex = 0;  ///< the vertex, or the first vertex of the edge, where it shows
  int other = 0;   ///< the other vertex or edge involved, where there is one; else the same
};

/// The first defect of a polygon in either orientation, or nothing: then it is simple and has an area.
/// `other` of a self-intersection is the edge met by edge `vertex`.
std::optional<DefectiveVertex> find_defect(const PointsRef& polygon);

/// Throws Error, with the vertex, the reason and the cure, unless a polygon is simple, has an area and runs
/// counter-clockwise: then everything of this library can be computed on it that wants no convex one.
void require_usable(const PointsRef& polygon);

/// The first corner of a counter-clockwise simple polygon that does not turn left by more than `min_turn`
/// (the sine of the turning angle): concave or straight. A corner that turns by more than a right angle is
/// never straight, however sharp. Nothing when the polygon is strictly convex. Exact when `min_turn` is 0.
std::optional<int> find_non_convex_corner(const PointsRef& polygon, double min_turn = 0);

/// Whether x lies in the closed polygon (either orientation, any simple polygon). Exact.
bool contains(const PointsRef& polygon, const Vec2& x);

/// How far x lies outside the closed polygon; 0 inside and on it.
double distance_outside(const PointsRef& polygon, const Vec2& x);

}  // namespace polyfem
