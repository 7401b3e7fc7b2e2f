/// \file An edge of an outline with its direction and its outward normal.
#pragma once

#include <ddacontact/detection/corner.hpp>
#include <ddacontact/detection/outline_table.hpp>

#include <algorithm>

namespace ddacontact {

/// Edge from a vertex of a counter-clockwise outline to the next.
struct DirectedEdge {
  Vec2 start, tangent, normal;  // outward normal of a counter-clockwise polygon
  double length;

  DirectedEdge(const Vec2& from, const Side& side)
      : start(from), tangent(side.tangent), normal(side.normal()), length(side.length) {}
  DirectedEdge(const Vec2& from, const Vec2& to) : start(from), tangent(to - from), length(tangent.norm()) {
    tangent /= length;
    normal = Vec2(tangent.y(), -tangent.x());
  }
  DirectedEdge(const PointsRef& polygon, Index edge)
      : DirectedEdge(Vec2(polygon.col(edge)), Vec2(polygon.col((edge + 1) % polygon.cols()))) {}
  double gap(const Vec2& x) const { return normal.dot(x - start); }
  /// Distance from its start to the projection of x, m; < 0 before the start.
  double along(const Vec2& x) const { return tangent.dot(x - start); }
  /// How far the projection of x lies beyond the nearer end; <= 0 within the edge.
  double overshoot(const Vec2& x) const { return std::max(-along(x), along(x) - length); }
};

}  // namespace ddacontact
