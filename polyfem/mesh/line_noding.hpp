/// \file Lines that cross to edges that meet at common vertices alone.
#pragma once

#include <polyfem/core/types.hpp>

#include <vector>

namespace polyfem {

/// A straight line between two points, and what it is to its user.
struct Segment {
  Vec2 from, to;
  int mark = 0;
};

/// Edges between vertices; no two of them cross, overlap or touch except at a common vertex.
struct NodedLines {
  /// Between two vertices.
  struct Edge {
    int from, to;
    int mark;  ///< of the segment that it is a part of; of the first one where segments overlap
  };
  std::vector<Vec2> vertices;
  std::vector<Edge> edges;
  double grid = 0;  ///< vertices lie on multiples of it
};

/// A power of two, about 1e-14 of the box of points and not below what a double can tell at their distance
/// from the origin.
double noding_grid(const PointsRef& points);

/// Snap rounding: vertices lie on multiples of `grid`, and an edge lies within `grid` of its segment. The
/// order of vertices and edges depends on the segments alone. Computed by GEOS; throws Error when it fails,
/// on coarser grids too.
NodedLines node_lines(const std::vector<Segment>& segments, double grid);

}  // namespace polyfem
