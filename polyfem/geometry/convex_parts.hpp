/// \file A concave polygon cut into few convex ones at its vertices.
#pragma once

#include <polyfem/core/types.hpp>

#include <vector>

namespace polyfem {

/// Convex polygons that fill a simple counter-clockwise one: of each the vertices, counter-clockwise, as
/// columns of `polygon`. A convex polygon is its own single part.
///
/// Every corner of a part turns by more than `least_turn` (a sine). Vertices that turn by less where they are
/// are left out, so that vertices on an edge make no cut and neighbouring parts may meet in a T; with
/// `least_turn` 0 the parts fill the polygon exactly, else to within that.
///
/// Cuts run from reflex corners along diagonals: those without an angle below 3 degrees first, of these those
/// that leave the fewest reflex corners, then those with the best angles. At the end cuts that turn out not
/// to be needed are taken back, those with the worst angles first (S. Hertel, K. Mehlhorn, "Fast
/// triangulation of simple polygons", 1983). Of r reflex corners come r + 1 parts at most where each has a
/// diagonal that makes it convex; r / 2 + 1 is the least possible. About O(r n^2).
std::vector<std::vector<int>> convex_parts(const PointsRef& polygon, double least_turn);

}  // namespace polyfem
