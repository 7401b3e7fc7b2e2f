#include <ddacontact/detection/contact_length.hpp>

#include <ddacontact/detection/directed_edge.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

double contact_length(const PointsRef& vertex_polygon, const PointsRef& edge_polygon,
                      const VertexEdge& contact, const PointsRef& unstrained,
                      const std::function<bool(int, int)>& bears, bool at_any_angle) {
  const Vec2 x = vertex_polygon.col(contact.vertex);
  const DirectedEdge e(edge_polygon, contact.edge);
  // The vertex at the end of a straight face, or before it one that bears: from an edge on, forth or back.
  const auto end_of_face = [&](const PointsRef& polygon, int block, int edge, bool forth) {
    for (int at = edge;;) {
      const int end = forth ? next(at, polygon) : at, on = forth ? end : previous(at, polygon);
      const bool goes_on = forth ? goes_straight_on(polygon, at, on) : goes_straight_on(polygon, on, at);
      if (!goes_on || bears(block, end)) return end;
      at = on;
    }
  };
  const auto reach = [&](bool along) {
    const int end = end_of_face(edge_polygon, contact.edge_block, contact.edge, along);
    return e.tangent.dot(edge_polygon.col(end) - x) * (along ? 1 : -1);
  };
  const auto length_towards = [&](int edge, bool forth) {
    const int neighbour = end_of_face(vertex_polygon, contact.vertex_block, edge, forth);
    const Vec2 way = vertex_polygon.col(neighbour) - x;
    if (!at_any_angle && std::abs(e.normal.dot(way)) > sin_parallel * way.norm()) return 0.0;
    const double onward = e.tangent.dot(way);
    const bool along = onward > 0;
    const double overlap = std::min(std::abs(onward), reach(along)) - std::max(0.0, -reach(!along));
    const double length = (unstrained.col(neighbour) - unstrained.col(contact.vertex)).norm();
    return std::max(0.0, overlap) / 2 * length / way.norm();
  };
  const double forward = length_towards(contact.vertex, true),
               back = length_towards(previous(contact.vertex, vertex_polygon), false);
  return corner_at(vertex_polygon, contact.vertex) == Corner::straight ? forward + back
                                                                       : std::max(forward, back);
}

}  // namespace ddacontact
