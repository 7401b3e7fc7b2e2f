#include "stress_fields.hpp"

#include <ddacontact/output/cell_view.hpp>
#include <polyfem/quadrature/polygon_rule.hpp>

#include <Eigen/LU>

#include <cmath>

namespace verification {

void for_each_stress(const Frame& frame, int block,
                     const std::function<void(const Vec2&, double, const Vec3&)>& visit) {
  polyfem::PolygonRule rule;
  polyfem::ShapeValues shape;
  for (int c = 0; c < frame.n_cells(); ++c) {
    if (frame.cells[c].block != block) continue;
    const CellView view(frame, c);
    const Points corners = view.local_corners();
    polyfem::make_polygon_rule(corners, polyfem::hammer_rule(5), rule);
    for (Index q = 0; q < rule.points.cols(); ++q) {
      view.basis()(corners, rule.points.col(q), shape);
      visit(view.corners().col(0) + rule.points.col(q), rule.weights[q], view.stress(shape));
    }
  }
}

double stress_error(const Frame& frame, int block, const StressField& exact,
                    const std::function<bool(const Vec2&)>& counts) {
  const Mat3 compliance = frame.elasticity[frame.materials[block]].inverse();
  double off = 0, all = 0;
  for_each_stress(frame, block, [&](const Vec2& x, double weight, const Vec3& stress) {
    if (counts && !counts(x)) return;
    const Vec3 known = exact(x), difference = stress - known;
    off += weight * difference.dot(compliance * difference);
    all += weight * known.dot(compliance * known);
  });
  return std::sqrt(off / all);
}

Vec3 mean_stress_near(const Frame& frame, int block, const Vec2& point, double radius) {
  Vec3 sum(0, 0, 0);
  double area = 0;
  for_each_stress(frame, block, [&](const Vec2& x, double weight, const Vec3& stress) {
    if ((x - point).norm() > radius) return;
    sum += weight * stress;
    area += weight;
  });
  return sum / area;
}

Scene static_scene(const BlockDescription& block, double poisson) {
  Scene scene = rock_scene(1, 4, 1e9);
  scene.analysis.mode = Mode::statics;
  scene.analysis.gravity = {0, 0};
  scene.materials[0].poisson = poisson;
  scene.blocks = {block};
  return scene;
}

void add_traction(Scene& scene, const Vec2& from, const Vec2& to,
                  const std::function<Vec2(const Vec2&)>& traction) {
  constexpr int parts = 64;
  const double gauss = 1 / std::sqrt(3.);
  for (int k = 0; k < parts; ++k)
    for (const double g : {-gauss, gauss}) {
      Load load;
      load.at = from + (k + 0.5 + g / 2) / parts * (to - from);
      load.force.value = traction(load.at) * (to - from).norm() / (2 * parts);
      scene.loads.push_back(load);
    }
}

BlockDescription meshed(const Points& vertices, CellKind kind, int cells, bool edge_nodes) {
  BlockDescription description = block(vertices);
  description.model = BlockModel::mesh;
  description.mesh.kind = kind;
  description.mesh.cells = cells;
  description.mesh.edge_nodes = edge_nodes;
  return description;
}

Frame frame_of(const BuiltScene& built) {
  return capture_frame(*built.stepper, built.labels, {});
}

int n_cells(const BuiltScene& built, int block) {
  return built.stepper->blocks().block(block).n_cells();
}

}  // namespace verification
