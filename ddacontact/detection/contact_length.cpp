#include <ddacontact/detection/contact_length.hpp>

#include <ddacontact/detection/directed_edge.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

/// A vertex nearer to an end of an edge than this part of its length is at that end.
constexpr double end_part = 1e-6;

}  // namespace

double contact_length(const PointsRef& vertex_polygon, int vertex, const PointsRef& edge_polygon, int edge,
                      const PointsRef& unstrained, bool at_any_angle) {
  const Vec2 x = vertex_polygon.col(vertex);
  const auto length_towards = [&](int neighbour) {
    const Vec2 y = vertex_polygon.col(neighbour);
    DirectedEdge e(edge_polygon, edge);
    if (!at_any_angle && std::abs(e.normal.dot(y - x)) > sin_parallel * (y - x).norm()) return 0.0;
    // From an end of the edge it goes on along the next one, where that is collinear.
    const double at = e.tangent.dot(x - e.start), onward = e.tangent.dot(y - x);
    const int after = next(edge, edge_polygon), before = previous(edge, edge_polygon);
    if (onward > 0 && at > (1 - end_part) * e.length && goes_straight_on(edge_polygon, edge, after))
      e = DirectedEdge(edge_polygon, after);
    else if (onward < 0 && at < end_part * e.length && goes_straight_on(edge_polygon, before, edge))
      e = DirectedEdge(edge_polygon, before);
    const double s = e.tangent.dot(x - e.start), t = e.tangent.dot(y - e.start);
    const double length = (unstrained.col(neighbour) - unstrained.col(vertex)).norm();
    return (std::min(std::max(s, t), e.length) - std::max(std::min(s, t), 0.0)) / 2 * length / (y - x).norm();
  };
  const double forward = std::max(0.0, length_towards(next(vertex, vertex_polygon))),
               back = std::max(0.0, length_towards(previous(vertex, vertex_polygon)));
  return corner_at(vertex_polygon, vertex) == Corner::straight ? forward + back : std::max(forward, back);
}

}  // namespace ddacontact
