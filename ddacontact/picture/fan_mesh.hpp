/// \file The triangles on which a field inside a block is drawn.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// The centroid fan of a polygon of n corners, each of its triangles divided into rings x rings alike.
///
/// Node 0 is the centroid; ring r = 1 .. rings holds n r nodes, counter-clockwise from the direction of
/// corner 0, and the last ring lies on the outline with the corners at every rings-th of its nodes.
class FanMesh {
 public:
  FanMesh(int n_corners, int rings) : n_corners_(n_corners), rings_(rings) {}

  int n_corners() const { return n_corners_; }
  int rings() const { return rings_; }
  int n_nodes() const { return first(rings_ + 1); }
  int n_outline_nodes() const { return n_corners_ * rings_; }
  /// The k-th node of the outline, k from 0 to n_outline_nodes (the first one again).
  int outline_node(int k) const { return node(rings_, k); }
  /// Whether a node is a corner of the polygon.
  bool is_corner(int node) const;

  /// Positions of all nodes, one a column.
  Points nodes(const PointsRef& outline, const Vec2& centroid) const;

  /// Calls `visit(a, b, c)` for each triangle, counter-clockwise like the polygon.
  template <class Visit>
  void for_each_triangle(Visit&& visit) const {
    for (int r = 1; r <= rings_; ++r)
      for (int sector = 0; sector < n_corners_; ++sector)
        for (int j = 0; j < r; ++j) {
          const int outer = sector * r + j, inner = sector * (r - 1) + j;
          visit(node(r - 1, inner), node(r, outer), node(r, outer + 1));
          if (j + 1 < r) visit(node(r - 1, inner), node(r, outer + 1), node(r - 1, inner + 1));
        }
  }

 private:
  int first(int ring) const { return ring == 0 ? 0 : 1 + n_corners_ * ring * (ring - 1) / 2; }
  int node(int ring, int k) const { return ring == 0 ? 0 : first(ring) + k % (n_corners_ * ring); }

  int n_corners_, rings_;
};

}  // namespace ddacontact
