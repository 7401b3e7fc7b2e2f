#include <ddacontact/time/caught_corners.hpp>

#include <ddacontact/contact/contact_positions.hpp>
#include <ddacontact/contact/contact_properties.hpp>

#include <algorithm>
#include <tuple>

namespace ddacontact {

int find_caught_block(const BlockSystem& blocks, const BlockState& state,
                      const std::vector<Contact>& contacts) {
  using Vertex = std::array<int, 2>;  // a block and its vertex
  const auto beside = [&](const Vertex& corner, int by) -> Vertex {
    const int n = blocks.block(corner[0]).vertices().count;
    return {corner[0], (corner[1] + by + n) % n};
  };
  const auto at_start = [&](const Vertex& corner) -> Vec2 {
    return blocks.block(corner[0]).reference().col(corner[1]);
  };
  const auto now = [&](const Vertex& corner) -> Vec2 {
    return state.origin.col(corner[0]) +
           state.position.col(blocks.block(corner[0]).vertices().first + corner[1]);
  };
  // Of a corner behind the line of an edge, from the vertex on which the edge begins.
  const auto depth = [&](const auto& place, const Vertex& edge, const Vertex& corner) {
    const Vec2 from = place(edge), along = place(beside(edge, 1)) - from;
    return polyfem::cross(along, place(corner) - from) / along.norm();
  };

  // Corners close to each other, either of which may be the contact's vertex; what bears, or did at the
  // start.
  std::vector<std::tuple<Vertex, Vertex, double>> meetings;
  std::vector<std::pair<Vertex, Vertex>> bearing;
  for (const Contact& contact : contacts) {
    if (contact.motion.rounding || !(contact.normal > 0 || contact.start_state != ContactState::open))
      continue;
    const Vertex vertex{contact.pair.vertex_block, contact.pair.vertex},
        start{contact.pair.edge_block, contact.pair.edge};
    bearing.push_back({vertex, start});
    for (const Vertex& end : {start, beside(start, 1)})
      if (contact.normal > 0 && (now(vertex) - now(end)).norm() <= near_corner * contact.size)
        for (const auto& [a, b] : {std::pair(vertex, end), {end, vertex}})
          meetings.push_back({a, b, contact.size});
  }
  if (!meetings.empty()) std::ranges::sort(bearing);
  for (const auto& [corner, other, size] : meetings)
    for (const auto& [vertex, edge] :
         std::ranges::equal_range(bearing, corner, {}, &std::pair<Vertex, Vertex>::first)) {
      const double lip = ContactProperties::default_lip * size, step = -depth(now, edge, other);
      if (edge[0] != other[0] && step > lip && step <= near_corner * size &&
          std::abs(depth(at_start, edge, other)) <= lip && depth(at_start, edge, beside(other, -1)) >= -lip &&
          depth(at_start, edge, beside(other, 1)) >= -lip)
        return corner[0];
    }
  return -1;
}

}  // namespace ddacontact
