/// \file An edge of an outline with its direction and its outward normal.
#pragma once

#include <ddacontact/detection/corner.hpp>
#include <ddacontact/detection/outline_table.hpp>

#include <algorithm>

namespace ddacontact {

/// From a vertex of a counter-clockwise outline to the next.
struct DirectedEdge {
  Vec2 start, tangent, normal;  // outward normal of a counter-clockwise polygon
  double length;

  DirectedEdge(const Vec2& from, const Side& side)
      : start(from), tangent(side.tangent), normal(side.normal()), length(side.length) {}
  DirectedEdge(const PointsRef& polygon, int edge) : start(polygon.col(edge)) {
    length = along(polygon, edge).norm();
    tangent = along(polygon, edge) / length;
    normal = Vec2(tangent.y(), -tangent.x());
  }
  double gap(const Vec2& x) const { return normal.dot(x - start); }
  /// How far the projection of x lies beyond the nearer end; <= 0 within the edge.
  double overshoot(const Vec2& x) const {
    const double s = tangent.dot(x - start);
    return std::max(-s, s - length);
  }
};

}  // namespace ddacontact
