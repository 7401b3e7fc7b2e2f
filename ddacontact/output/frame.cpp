#include <ddacontact/output/frame.hpp>

#include <ddacontact/contact/contact_positions.hpp>
#include <ddacontact/output/block_summary.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/geometry/area_moments.hpp>

namespace ddacontact {

namespace {

FrameContact describe(const ContactRecord& contact, const Stepper& stepper, const Vec2& frame_origin,
                      const Frame& frame) {
  const VertexEdge& pair = contact.pair;
  const auto edge_outline = frame.outline(pair.edge_block);
  const Vec2 edge = edge_outline.col((pair.edge + 1) % edge_outline.cols()) - edge_outline.col(pair.edge);
  FrameContact described;
  described.vertex_block = pair.vertex_block;
  described.edge_block = pair.edge_block;
  described.position = frame.outline(pair.vertex_block).col(pair.vertex);
  described.normal = Vec2(edge.y(), -edge.x()).normalized();
  const double inset = stepper.contact_properties().inset(contact);
  if (stepper.blocks().has_rounded_corners() || inset > 0) {
    const auto [i, j, k] = motion_of(stepper.blocks(), stepper.state(), pair, inset).slip_positions();
    described.position = i + stepper.state().origin.col(pair.edge_block) + frame_origin;
    described.normal = Vec2((k - j).y(), (j - k).x()).normalized();
  }
  described.gap = contact.end_gap;
  described.normal_force = contact.normal;
  described.shear_force = contact.shear;  // an edge runs along its outward normal turned left
  described.state = contact.history.state;
  return described;
}

/// The index of an elasticity among those of the frame, where it is put when it is new.
int elasticity_index(const Mat3& elasticity, int material, Frame& frame) {
  if (frame.elasticity[material] == elasticity) return material;
  for (std::size_t k = frame.material_names.size(); k < frame.elasticity.size(); ++k)
    if (frame.elasticity[k] == elasticity) return static_cast<int>(k);
  frame.elasticity.push_back(elasticity);
  return static_cast<int>(frame.elasticity.size()) - 1;
}

/// How many corners and cells the blocks have.
struct Counts {
  Index corners = 0, cells = 0;
};

Counts add_cells(const BlockSystem& system, Frame& frame) {
  Counts counts;
  for (int b = 0; b < system.n_blocks(); ++b) {
    if (!system.is_present(b)) continue;
    const Block& block = system.block(b);
    for (int c = 0; c < block.n_cells(); ++c) {
      const BlockCell cell = block.cell(c);
      const int n_corners = static_cast<int>(cell.corners.size());
      frame.cells.push_back(
          {b, {static_cast<int>(counts.corners), n_corners}, frame.materials[b], cell.basis});
      for (int point : cell.corners) frame.corner_points.push_back(block.points().first + point);
      counts.corners += n_corners;
      ++counts.cells;
    }
  }
  return counts;
}

/// Displacements w of the corners of an outline x that have moved them there, such that their gradients are
/// the same on x as on the outline before, x - w, to first order in how they vary: else what an initial
/// stress is relieved of differs by strain times that stress.
Points over_present_outline(const Points& w, const Points& x) {
  const Points before = x - w;
  Mat2 gradient = Mat2::Zero();
  for (Index i = 0; i < w.cols(); ++i)
    gradient += w.col(i) * polyfem::boundary_integral(before, i).transpose();
  return w + gradient / polyfem::signed_area(before) * w;
}

void set_stress(const BlockSystem& system, const BlockState& state, const Counts& counts, Frame& frame) {
  frame.strain_displacement.resize(2, counts.corners);
  frame.stress_offset.resize(3, counts.cells);
  frame.mean_stress.resize(3, system.n_blocks());
  Index c = 0;
  for (int b = 0; b < system.n_blocks(); ++b) {
    if (!system.is_present(b)) {
      frame.mean_stress.col(b).setZero();
      continue;
    }
    const Block& block = system.block(b);
    frame.mean_stress.col(b) = mean_stress(block, state);
    for (int k = 0; k < block.n_cells(); ++k, ++c) {
      const CellStress stress = block.cell_stress(state, k);
      FrameCell& cell = frame.cells[c];
      cell.elasticity = elasticity_index(stress.elasticity, frame.materials[b], frame);
      const std::span<const int> corners = frame.corners(static_cast<int>(c));
      const Points x = frame.position(Eigen::all, corners).colwise() - Vec2(frame.position.col(corners[0]));
      frame.strain_displacement.middleCols(cell.corners.first, cell.corners.count) =
          stress.offset.isZero(0) ? stress.strain_displacement
                                  : over_present_outline(stress.strain_displacement, x);
      frame.stress_offset.col(c) = stress.offset;
    }
  }
}

}  // namespace

Range Frame::points(int block) const {
  const int first = blocks[block].first;
  const int end = block + 1 < n_blocks() ? blocks[block + 1].first : static_cast<int>(position.cols());
  return {first, end - first};
}

std::vector<int> Frame::present_blocks() const {
  std::vector<int> present;
  for (const FrameCell& cell : cells)
    if (present.empty() || present.back() != cell.block) present.push_back(cell.block);
  return present;
}

void Frame::add_outline_cell(int block) {
  const auto [first, count] = blocks[block];
  cells.push_back(
      {block, {static_cast<int>(corner_points.size()), count}, materials[block], &polyfem::wachspress});
  for (int v = 0; v < count; ++v) corner_points.push_back(first + v);
}

bool Frame::has_outline_cells_only() const {
  if (n_cells() != n_blocks() || !stress_offset.isZero(0)) return false;
  for (int b = 0; b < n_blocks(); ++b) {
    const auto [first, count] = blocks[b];
    const FrameCell& cell = cells[b];
    const std::span<const int> of_cell = corners(b);
    if (cell.block != b || cell.basis != &polyfem::wachspress || cell.elasticity != materials[b] ||
        cell.corners.first != first || cell.corners.count != count || points(b).count != count)
      return false;
    for (int v = 0; v < count; ++v)
      if (of_cell[v] != first + v) return false;
  }
  return true;
}

Frame capture_frame(const Stepper& stepper, const Labels& labels, const FrameFields& fields) {
  const BlockSystem& system = stepper.blocks();
  const BlockState& state = stepper.state();
  Frame frame;
  frame.step = stepper.counts().steps;
  frame.time = state.time;
  frame.materials = labels.block_materials;
  frame.material_names = labels.material_names;
  frame.elasticity.assign(labels.material_names.size(), Mat3::Zero());
  frame.position = system.positions(state).colwise() + labels.origin;
  if (fields.displacement) frame.displacement = system.displacements(state);
  if (fields.velocity) frame.velocity.resize(2, state.position.cols());
  for (int b = 0; b < system.n_blocks(); ++b) {
    const Block& block = system.block(b);
    frame.blocks.push_back(block.vertices());
    frame.elasticity[labels.block_materials[b]] = block.material().elasticity;
    for (int p = 0; fields.velocity && p < block.n_points(); ++p)
      frame.velocity.col(block.points().first + p) = block.vertex_map(p)(state.velocity);
  }
  for (const BlockField& field : block_fields()) {
    VectorXd& values = frame.block_values[field.name];
    values.setZero(system.n_blocks());
    for (int b = 0; b < system.n_blocks(); ++b)
      if (system.is_present(b)) values[b] = field.value(stepper, b);
  }
  const Counts counts = add_cells(system, frame);
  if (fields.stress) set_stress(system, state, counts, frame);
  for (const ContactRecord& contact : stepper.contacts())
    if (contact.was_closed) frame.contacts.push_back(describe(contact, stepper, labels.origin, frame));
  return frame;
}

}  // namespace ddacontact
