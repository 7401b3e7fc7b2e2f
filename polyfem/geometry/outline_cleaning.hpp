/// \file Takes vertices out of an outline that its shape hardly needs.
#pragma once

#include <polyfem/core/types.hpp>

#include <vector>

namespace polyfem {

/// An outline with fewer vertices.
struct CleanedOutline {
  Points polygon;
  std::vector<std::vector<int>> sources;  ///< the given vertices that each one stands for, in ascending order
  int n_removed = 0;                      ///< vertices fewer than before
};

/// A simple counter-clockwise polygon without the vertices that turn, to either side, by at most `least_turn`
/// (a sine), the straightest first, each judged by what is left around it. 0 drops those exactly on the line
/// between their neighbours. A vertex stays when the polygon would not be simple without it. About O(n^2).
CleanedOutline drop_straight_vertices(const PointsRef& polygon, double least_turn);

/// A simple counter-clockwise polygon without edges shorter than `shortest`: the ends of each, the shortest
/// first, become one vertex in the middle, or at one end where the polygon would not be simple otherwise.
/// An edge for which there is no such place stays, and so does a triangle. About O(n^2).
CleanedOutline merge_ends_of_short_edges(const PointsRef& polygon, double shortest);

}  // namespace polyfem
