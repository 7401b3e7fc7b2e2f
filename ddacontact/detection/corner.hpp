/// \file Corners of a counter-clockwise simple polygon as contacts see them: convex, straight or reflex.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// Sine of 3 degrees: edges that turn by no more count as one straight line.
inline constexpr double sin_parallel = 0.0523;

/// How an outline turns at a vertex.
enum class Corner {
  convex,    ///< turns left
  straight,  ///< turns by no more than 3 degrees, either way
  reflex     ///< turns right: nothing can be touched with it first
};

/// The vertex after k.
inline int next(int k, const PointsRef& polygon) {
  return k + 1 == polygon.cols() ? 0 : k + 1;
}
/// The vertex before k.
inline int previous(int k, const PointsRef& polygon) {
  return (k == 0 ? static_cast<int>(polygon.cols()) : k) - 1;
}

/// An edge as a vector.
inline Vec2 along(const PointsRef& polygon, int edge) {
  return polygon.col(next(edge, polygon)) - polygon.col(edge);
}

/// Turn between the edges before and after a vertex, given as vectors.
Corner turn_between(const Vec2& before, const Vec2& after);
/// Turn of an outline at a vertex.
Corner corner_at(const PointsRef& polygon, int vertex);

/// Whether the edges from `from` to `to`, both included, are collinear: straight corners, and
/// no edge in a direction more than 3 degrees from that of `from`.
bool are_collinear(const PointsRef& polygon, int from, int to);

/// Whether it turns left from edge `from` to edge `to`, by no reflex corner and by no more than about half a
/// turn: a point beyond both edges can enter through one of them only.
bool turns_left(const PointsRef& polygon, int from, int to);

/// Length of the collinear outline beyond the end of an edge (`forth`) or before its start, m.
double straight_length(const PointsRef& polygon, int edge, bool forth);

}  // namespace ddacontact
