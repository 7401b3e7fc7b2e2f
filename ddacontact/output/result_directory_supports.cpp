#include <ddacontact/output/result_directory.hpp>

#include <polyfem/basis/mean_value.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

/// The reactions of a block by the scene's vertices: what holds other points is shared among these with the
/// same resultant and moment.
Points at_scene_vertices(const Block& block, const OutlineLabels& labels, const Points& reactions) {
  const int n = labels.n_vertices;
  Points vertices(2, n), forces = Points::Zero(2, n);
  for (int p = 0; p < block.n_vertices(); ++p) {
    if (labels.vertex[p] >= n) continue;
    vertices.col(labels.vertex[p]) = block.reference().col(p);
    forces.col(labels.vertex[p]) = reactions.col(block.points().first + p);
  }
  polyfem::ShapeValues shape;
  for (int p = 0; p < block.n_points(); ++p) {
    const Vec2 force = reactions.col(block.points().first + p);
    if ((p < block.n_vertices() && labels.vertex[p] < n) || force.isZero(0)) continue;
    polyfem::mean_value(vertices, block.reference().col(p), shape);
    forces += force * shape.values.transpose();
  }
  return forces;
}

}  // namespace

void ResultDirectory::write_support_history(const Stepper& stepper) {
  const BlockSystem& blocks = stepper.blocks();
  for (const int b : labels_.supported_blocks) {
    if (!blocks.is_present(b)) continue;
    const Vec2 force = blocks.block(b).points().columns_of(stepper.reactions()).rowwise().sum();
    supports_->row(stepper.counts().steps, stepper.state().time, labels_.block_names[b], force.x(),
                   force.y());
  }
}

void ResultDirectory::write_supports(const Stepper& stepper) {
  CsvFile csv(file("supports.csv"), "block,vertex,fx,fy");
  const BlockSystem& blocks = stepper.blocks();
  const std::vector<int>& held = blocks.supported_vertices;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    const std::vector<int> order = labels_.outlines[b]->in_scene_order();
    const auto is_prescribed = [&](int scene_v) {
      return std::binary_search(held.begin(), held.end(), block.vertices().first + order[scene_v]);
    };
    const int n = labels_.outlines[b]->n_vertices;
    bool any_prescribed = false;
    for (int v = 0; v < n; ++v) any_prescribed = any_prescribed || is_prescribed(v);
    if (!any_prescribed) continue;
    const Points forces = at_scene_vertices(block, *labels_.outlines[b], stepper.reactions());
    for (int v = 0; v < n; ++v)
      if (is_prescribed(v)) csv.row(labels_.block_names[b], v, forces(0, v), forces(1, v));
  }
  csv.close();
}

}  // namespace ddacontact
