/// \file How much the outline of a polygon turns at a corner.
#pragma once

#include <polyfem/core/types.hpp>

#include <algorithm>
#include <limits>

namespace polyfem {

/// Sine of the turning angle to the left; 1 when it is more than a right angle: sharp corners are never
/// straight. Negative at a concave corner.
inline double turn_sine(const Vec2& before, const Vec2& corner, const Vec2& after) {
  const Vec2 in = corner - before, out = after - corner;
  const double turn = cross(in, out), straight = in.dot(out);
  if (straight <= 0) return turn > 0 ? 1 : -1;
  return turn / (in.norm() * out.norm());
}

/// The least over all corners k of a polygon whose vertices are `vertex(k)`.
template <class Vertex>
double least_turn(int n_vertices, const Vertex& vertex) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < n_vertices; ++k)
    least = std::min(
        least, turn_sine(vertex((k + n_vertices - 1) % n_vertices), vertex(k), vertex((k + 1) % n_vertices)));
  return least;
}

}  // namespace polyfem
