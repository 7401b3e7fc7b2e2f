/// \file A block divided into polygon cells.
#pragma once

#include <ddacontact/core/options.hpp>

#include <vector>

namespace ddacontact {

/// Cells that share their corners and fill an outline.
struct BlockMesh {
  /// Corner on an edge that stays straight: it moves with the ends of the edge.
  struct EdgePoint {
    int point, start, end;  ///< start and end: of the edge, as points
    double along;           ///< from the start, 0..1
  };

  Points points;  ///< first the vertices of the outline that contacts act on, counter-clockwise from the
                  ///< block's vertex 0; then the corners inside; then those of `on_straight_edges`
  int n_outline = 0;
  std::vector<int> vertex;                   ///< number in the outline of each vertex of the block
  std::vector<std::vector<int>> cells;       ///< points, counter-clockwise
  std::vector<EdgePoint> on_straight_edges;  ///< none with nodes on the edges
};

/// Divides a simple, counter-clockwise outline. Voronoi cells are strictly convex but for corners where the
/// outline has a straight one; quads need a convex outline of four corners and are a grid mapped bilinearly.
/// Cells larger than `options.at_contact` and their distance from the points of `contact` together are
/// divided at their corners. Throws Error when quads do not fit the outline, when the cells would be more
/// than a million, and for outlines that polyfem cannot divide.
BlockMesh divide(const PointsRef& outline, const MeshOptions& options, const std::vector<Vec2>& contact = {});

}  // namespace ddacontact
