#include <ddacontact/contact/contact_place.hpp>

namespace ddacontact {

namespace {

/// None where corners are sharp.
std::optional<Rounding> rounding_of(const BlockSystem& blocks, const VertexEdge& pair,
                                    const VertexEdgePlace& place) {
  if (!blocks.has_rounded_corners()) return std::nullopt;
  const RoundedBlock &of_vertex = blocks.rounded(pair.vertex_block),
                     &of_edge = blocks.rounded(pair.edge_block);
  const auto& [i, j, k, after_i] = place;
  Rounding rounding{
      .centre = of_vertex.corners[pair.vertex].centre, .radius = of_vertex.radius, .corner = pair.corner};
  const Vec2 centre = rounding.centre.at(i, after_i), along = k - j;
  Vec2 normal = Vec2(along.y(), -along.x()).normalized();
  if (pair.corner) {
    const Vec2 other = of_edge.corners[pair.edge].centre.at(j, k);
    if (centre != other) normal = (centre - other).normalized();
    const Vec2 half_line = along.norm() / 2 * Vec2(-normal.y(), normal.x());
    rounding.start = SegmentPoint::that_is_at(other - half_line, j, k);
    rounding.end = SegmentPoint::that_is_at(other + half_line, j, k);
    rounding.radius += of_edge.radius;
  }
  rounding.surface = SegmentPoint::that_is_at(centre - of_vertex.radius * normal, i, after_i);
  return rounding;
}

}  // namespace

VertexEdgePlace place_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair) {
  const Range &of_vertex = blocks.block(pair.vertex_block).vertices(),
              &of_edge = blocks.block(pair.edge_block).vertices();
  const Vec2 shift = state.origin.col(pair.vertex_block) - state.origin.col(pair.edge_block);
  return {state.position.col(of_vertex.first + pair.vertex) + shift,
          state.position.col(of_edge.first + pair.edge),
          state.position.col(of_edge.first + (pair.edge + 1) % of_edge.count),
          state.position.col(of_vertex.first + (pair.vertex + 1) % of_vertex.count) + shift};
}

MovingVertexEdge motion_of(const BlockSystem& blocks, const BlockState& state, const VertexEdge& pair) {
  const Block &vertex_block = blocks.block(pair.vertex_block), &edge_block = blocks.block(pair.edge_block);
  MovingVertexEdge motion{.start = place_of(blocks, state, pair),
                          .i = vertex_block.vertex_map(pair.vertex),
                          .j = edge_block.vertex_map(pair.edge),
                          .k = edge_block.vertex_map((pair.edge + 1) % edge_block.n_vertices())};
  motion.rounding = rounding_of(blocks, pair, motion.start);
  if (motion.rounding)
    motion.after_i = vertex_block.vertex_map((pair.vertex + 1) % vertex_block.n_vertices());
  return motion;
}

}  // namespace ddacontact
