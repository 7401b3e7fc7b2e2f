#include <ddacontact/detection/contact_length.hpp>

#include <ddacontact/detection/directed_edge.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

ContactLength contact_length(const PointsRef& vertex_polygon, const PointsRef& edge_polygon,
                             const VertexEdge& contact, const PointsRef& unstrained,
                             const std::function<bool(int, int)>& bears, bool at_any_angle) {
  assert(contact.vertex < vertex_polygon.cols() && contact.edge < edge_polygon.cols());
  assert(unstrained.cols() == vertex_polygon.cols());
  const Vec2 x = vertex_polygon.col(contact.vertex);
  const DirectedEdge e(edge_polygon, contact.edge);
  // The vertex at the end of a straight face, or before it one that bears: from an edge on, forth or back.
  const auto end_of_face = [&](const PointsRef& polygon, int block, int edge, bool forth) {
    for (int at = edge;;) {
      const int end = forth ? next(at, polygon) : at, on = forth ? end : previous(at, polygon);
      const bool goes_on = forth ? are_collinear(polygon, at, on) : are_collinear(polygon, on, at);
      if (!goes_on || bears(block, end)) return end;
      at = on;
    }
  };
  const auto reach = [&](bool along) {
    const int end = end_of_face(edge_polygon, contact.edge_block, contact.edge, along);
    return e.tangent.dot(edge_polygon.col(end) - x) * (along ? 1 : -1);
  };
  // Half of the way to a neighbour: on this edge or, beyond its end, on the next one, where its middle is.
  const auto half = [&](double length, bool along) -> ContactLength {
    const double from_start = e.tangent.dot(x - e.start), to_end = along ? e.length - from_start : from_start;
    if (length / 2 <= to_end) return {length, 0, -1};
    return {0, length, along ? next(contact.edge, edge_polygon) : previous(contact.edge, edge_polygon)};
  };
  const int after = end_of_face(vertex_polygon, contact.vertex_block, contact.vertex, true),
            before = end_of_face(vertex_polygon, contact.vertex_block,
                                 previous(contact.vertex, vertex_polygon), false);
  const auto inclination = [&](int neighbour) {
    const Vec2 way = vertex_polygon.col(neighbour) - x;
    return std::abs(e.normal.dot(way)) / way.norm();
  };
  const auto length_towards = [&](int neighbour) -> ContactLength {
    if (!at_any_angle && inclination(neighbour) > sin_parallel) return {};
    const Vec2 way = vertex_polygon.col(neighbour) - x;
    const double onward = e.tangent.dot(way);
    const bool along = onward > 0;
    const double overlap = std::min(std::abs(onward), reach(along)) - std::max(0.0, -reach(!along));
    const double length = (unstrained.col(neighbour) - unstrained.col(contact.vertex)).norm();
    return half(std::max(0.0, overlap) / 2 * length / way.norm(), along);
  };
  if (corner_at(vertex_polygon, contact.vertex) != Corner::straight)
    return length_towards(inclination(after) < inclination(before) ? after : before);
  const ContactLength forward = length_towards(after), back = length_towards(before);
  return {forward.on_edge + back.on_edge, forward.beyond + back.beyond,
          std::max(forward.edge_beyond, back.edge_beyond)};
}

}  // namespace ddacontact
