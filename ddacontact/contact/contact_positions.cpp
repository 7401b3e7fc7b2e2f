#include <ddacontact/contact/contact_positions.hpp>

#include <ddacontact/detection/corner.hpp>

namespace ddacontact {

namespace {

/// Of the pair at these positions.
Rounding rounding_of(const BlockSystem& blocks, const VertexEdge& pair, const RoundedPositions& positions,
                     double of_corner) {
  const RoundedBlock &of_vertex = blocks.rounded(pair.vertex_block),
                     &of_edge = blocks.rounded(pair.edge_block);
  const auto& [i, j, k] = static_cast<const VertexEdgePositions&>(positions);
  const double radius = blocks.corner_radius(pair.vertex_block, pair.edge_block);
  Rounding rounding{.centre = of_vertex.centre(pair.vertex, radius), .radius = radius, .corner = pair.corner};
  const Vec2 centre = rounding.centre.at(i, positions.after_i), along = k - j;
  Vec2 normal = Vec2(along.y(), -along.x()).normalized();
  if (pair.corner) {
    rounding.radius += of_corner;
    rounding.other_centre = of_edge.centre(pair.edge, of_corner);
    const Vec2 other = rounding.other_centre.at(j, k);
    if (centre != other) normal = (centre - other).normalized();
    const Vec2 middle = other + of_corner * normal,
               half_line = along.norm() / 2 * Vec2(-normal.y(), normal.x());
    rounding.start = SegmentPoint::that_is_at(middle - half_line, j, k);
    rounding.end = SegmentPoint::that_is_at(middle + half_line, j, k);
  }
  rounding.surface = SegmentPoint::that_is_at(centre - radius * normal, i, positions.after_i);
  return rounding;
}

/// Of a sharp vertex whose forces act at a distance from it.
Rounding inset_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair,
                  const RoundedPositions& positions, double inset) {
  const Block& block = blocks.block(pair.vertex_block);
  const PointsRef outline = block.outline(state);
  Rounding rounding;
  if (corner_at(outline, pair.vertex) == Corner::straight) return rounding;
  const auto towards = [&](int neighbour) -> Vec2 {
    return (outline.col(neighbour) - outline.col(pair.vertex)).normalized();
  };
  const Vec2 after = towards(next(pair.vertex, outline)), before = towards(previous(pair.vertex, outline)),
             edge = positions.k - positions.j;
  const Vec2 along = std::abs(edge.dot(after)) > std::abs(edge.dot(before)) ? after : before;
  rounding.centre = rounding.surface =
      SegmentPoint::that_is_at(positions.i + inset * along, positions.i, positions.after_i);
  return rounding;
}

}  // namespace

RoundedPositions positions_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair) {
  const Range &of_vertex = blocks.block(pair.vertex_block).vertices(),
              &of_edge = blocks.block(pair.edge_block).vertices();
  const Vec2 shift = state.origin.col(pair.vertex_block) - state.origin.col(pair.edge_block);
  return {{state.position.col(of_vertex.first + pair.vertex) + shift,
           state.position.col(of_edge.first + pair.edge),
           state.position.col(of_edge.first + (pair.edge + 1) % of_edge.count)},
          state.position.col(of_vertex.first + (pair.vertex + 1) % of_vertex.count) + shift};
}

void set_maps(const BlockSystem& blocks, const VertexEdge& pair, MovingVertexEdge& motion) {
  const Block &of_vertex = blocks.block(pair.vertex_block), &of_edge = blocks.block(pair.edge_block);
  motion.i = of_vertex.vertex_map(pair.vertex);
  motion.j = of_edge.vertex_map(pair.edge);
  motion.k = of_edge.vertex_map((pair.edge + 1) % of_edge.n_vertices());
  motion.change_rounding([&](MovingRounding& of) {
    of.after_i = of_vertex.vertex_map((pair.vertex + 1) % of_vertex.n_vertices());
  });
}

MovingVertexEdge motion_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair,
                           double inset, double of_corner) {
  MovingVertexEdge motion;
  const RoundedPositions start = positions_of(blocks, state, pair);
  motion.start = start;
  if (blocks.has_rounded_corners() || inset > 0)
    motion.rounding = std::make_shared<const MovingRounding>(
        MovingRounding{blocks.has_rounded_corners() ? rounding_of(blocks, pair, start, of_corner)
                                                    : inset_of(blocks, state, pair, start, inset),
                       start.after_i});
  set_maps(blocks, pair, motion);
  return motion;
}

bool exchange_vertices(const BlockSystem& blocks, const BlockState& state, double near, const VertexEdge& old,
                       const VertexEdge& pair) {
  if (old.vertex_block != pair.edge_block || old.corner || pair.corner) return false;
  const auto positions = [&](int block, int vertex) -> Vec2 {
    const Vec2 shift = state.origin.col(block) - state.origin.col(pair.edge_block);
    return state.position.col(blocks.block(block).vertices().first + vertex) + shift;
  };
  const auto ends = [&](int vertex, int edge, int block) {
    return vertex == edge || vertex == (edge + 1) % blocks.block(block).n_vertices();
  };
  return ends(old.vertex, pair.edge, pair.edge_block) && ends(pair.vertex, old.edge, old.edge_block) &&
         (positions(pair.vertex_block, pair.vertex) - positions(old.vertex_block, old.vertex)).norm() <= near;
}

}  // namespace ddacontact
