#include <ddacontact/output/frame.hpp>

#include <ddacontact/output/block_summary.hpp>

#include <Eigen/LU>

namespace ddacontact {

namespace {

FrameContact describe(const Contact& contact, const Frame& frame) {
  const VertexEdge& pair = contact.pair;
  const auto edge_outline = frame.outline(pair.edge_block);
  const Vec2 edge = edge_outline.col((pair.edge + 1) % edge_outline.cols()) - edge_outline.col(pair.edge);
  FrameContact described;
  described.vertex_block = pair.vertex_block;
  described.edge_block = pair.edge_block;
  described.position = frame.outline(pair.vertex_block).col(pair.vertex);
  described.normal = Vec2(edge.y(), -edge.x()).normalized();
  described.gap = contact.end_gap;
  described.normal_force = contact.normal;
  described.shear_force = contact.shear;  // an edge runs along its outward normal turned left
  described.state = contact.history.state;
  return described;
}

/// Of a displacement u with the gradient du_a / dx_b.
Vec3 strain_of(const Mat2& gradient) {
  return {gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0)};
}

}  // namespace

Vec3 Frame::stress(int block, const polyfem::ShapeValues& shape) const {
  const auto w = strain_displacement.middleCols(blocks[block].first, blocks[block].count);
  return elasticity[materials[block]] * strain_of(w * shape.gradients.transpose());
}

Vec3 Frame::stress_at_vertex(int block, int vertex) const {
  const auto [first, count] = blocks[block];
  const int here = first + vertex, next = first + (vertex + 1) % count,
            before = first + (vertex + count - 1) % count;
  Mat2 edges, change;
  edges << position.col(next) - position.col(here), position.col(before) - position.col(here);
  change << strain_displacement.col(next) - strain_displacement.col(here),
      strain_displacement.col(before) - strain_displacement.col(here);
  return elasticity[materials[block]] * strain_of(change * edges.inverse());
}

Frame capture_frame(const Stepper& stepper, const Labels& labels, const FrameFields& fields) {
  const BlockSystem& system = stepper.blocks();
  const BlockState& state = stepper.state();
  const int n_blocks = system.n_blocks();
  Frame frame;
  frame.step = stepper.counts().steps;
  frame.time = state.time;
  frame.materials = labels.block_materials;
  frame.material_names = labels.material_names;
  frame.elasticity.assign(labels.material_names.size(), Mat3::Zero());
  frame.position = system.positions(state).colwise() + labels.origin;
  if (fields.displacement) frame.displacement = system.displacements(state);
  if (fields.velocity) frame.velocity.resize(2, state.position.cols());
  if (fields.stress) {
    frame.strain_displacement.resize(2, state.position.cols());
    frame.mean_stress.resize(3, n_blocks);
  }
  for (int b = 0; b < n_blocks; ++b) {
    const Block& block = system.block(b);
    const Range& vertices = block.vertices();
    frame.blocks.push_back(vertices);
    frame.elasticity[labels.block_materials[b]] = block.material().elasticity;
    for (int v = 0; fields.velocity && v < vertices.count; ++v)
      frame.velocity.col(vertices.first + v) = block.vertex_map(v)(state.velocity);
    if (fields.stress) {
      frame.strain_displacement.middleCols(vertices.first, vertices.count) = block.strain_displacement(state);
      frame.mean_stress.col(b) = mean_stress(block, state);
    }
  }
  for (const Contact& contact : stepper.contacts())
    if (contact.was_closed) frame.contacts.push_back(describe(contact, frame));
  return frame;
}

}  // namespace ddacontact
