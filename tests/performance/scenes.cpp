#include "scenes.hpp"

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace performance {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double brick_length = 1, brick_height = 0.5;

/// Waves cross tens of blocks in a static step, friction finds its way in a few of them, and hardly a step
/// has to be cut: with steps of 1 s many of the first ones are.
constexpr double settling_step = 0.03;
constexpr int n_settling_steps = 100;

Scene rock_scene(double friction_angle = 35) {
  Scene scene;
  scene.materials = {{"rock", 2500, 10e9, 0.2}};
  scene.joints.resize(1);
  scene.joints[0].friction_angle = friction_angle;
  scene.contact.normal_stiffness = 40 * scene.materials[0].young;
  scene.contact.tangential_stiffness = scene.contact.normal_stiffness / 2.5;
  scene.analysis.max_displacement_ratio = 10;
  set_time_step(scene, 1e-2);
  return scene;
}

BlockDescription& add_block(Scene& scene, const Points& outline, bool fixed = false) {
  BlockDescription& block = scene.blocks.emplace_back();
  block.vertices = outline;
  block.fixed = fixed;
  return block;
}

Points box(double left, double bottom, double right, double top) {
  Points p(2, 4);
  p << left, right, right, left,  //
      bottom, bottom, top, top;
  return p;
}

int whole_root(double n) {
  return std::max(1, static_cast<int>(std::lround(std::sqrt(n))));
}

/// Running bond of `n_rows` rows of `n_columns`, of bricks `length` x `height` whose outline `shape` gives.
template <class Shape>
void add_bond(Scene& scene, int n_rows, int n_columns, double length, double height, const Shape& shape) {
  add_block(scene, box(-length, -2 * height, (n_columns + 1) * length, 0), true);
  for (int row = 0; row < n_rows; ++row) {
    const bool halves = row % 2 == 1;
    for (int column = 0; column < n_columns + halves; ++column) {
      const double left = std::max(0., column - 0.5 * halves),
                   right = std::min<double>(n_columns, column + 1 - 0.5 * halves);
      add_block(scene, shape(left * length, row * height, right * length, (row + 1) * height));
    }
  }
}

/// A box with rounded corners of four vertices each.
Points rounded_box(double left, double bottom, double right, double top) {
  constexpr int per_corner = 4;
  const double radius = 0.2 * (top - bottom);
  const std::array<Vec2, 4> centres{Vec2(right - radius, bottom + radius), Vec2(right - radius, top - radius),
                                    Vec2(left + radius, top - radius), Vec2(left + radius, bottom + radius)};
  Points p(2, 4 * per_corner);
  for (int corner = 0; corner < 4; ++corner)
    for (int k = 0; k < per_corner; ++k) {
      const double angle = (corner - 1 + k / (per_corner - 1.)) * std::numbers::pi / 2;
      p.col(corner * per_corner + k) = centres[corner] + radius * Vec2(std::cos(angle), std::sin(angle));
    }
  return p;
}

/// What of a convex polygon lies where normal . x <= offset; may be empty.
Points clipped(const Points& polygon, const Vec2& normal, double offset) {
  std::vector<Vec2> kept;
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 a = polygon.col(k), b = polygon.col((k + 1) % polygon.cols());
    const double out_a = normal.dot(a) - offset, out_b = normal.dot(b) - offset;
    if (out_a <= 0) kept.push_back(a);
    if ((out_a < 0) != (out_b < 0) && out_a != 0 && out_b != 0)
      kept.push_back(a + out_a / (out_a - out_b) * (b - a));
  }
  Points result(2, static_cast<Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) result.col(static_cast<Index>(k)) = kept[k];
  return result;
}

Scene slope_with(int n, double friction_angle) {
  constexpr double face = 60 * degree, dip = 20 * degree, least_area = 0.05, least_edge = 0.02;
  // Blocks of 1 m x 1 m on a trapezoid whose top is as long as it is high.
  const double height = std::sqrt(n / (1 + 0.5 / std::tan(face))), top = height,
               bottom = top + height / std::tan(face);
  Scene scene = rock_scene(friction_angle);
  add_block(scene, box(-height, -1, bottom + 1, 0), true);
  add_block(scene, box(bottom, 0, bottom + 1, height), true);
  const Vec2 out_of_face(-std::sin(face), std::cos(face));
  const Mat2 turn = Eigen::Rotation2Dd(dip).toRotationMatrix();
  const int search_margin = static_cast<int>(2 * bottom) + 2;
  for (int row = -search_margin; row < search_margin; ++row)
    for (int column = -search_margin; column < search_margin; ++column) {
      Points block = turn * box(column, row, column + 1, row + 1);
      if (block.row(1).maxCoeff() <= 0 || block.row(1).minCoeff() >= height ||
          block.row(0).minCoeff() >= bottom || (out_of_face.transpose() * block).minCoeff() >= 0)
        continue;
      block = clipped(block, -Vec2::UnitY(), 0);
      block = clipped(block, Vec2::UnitY(), height);
      block = clipped(block, Vec2::UnitX(), bottom);
      block = clipped(block, out_of_face, 0);
      if (block.cols() < 3 || polyfem::area_moments(block).area < least_area) continue;
      double shortest = 1;
      for (Index k = 0; k < block.cols(); ++k)
        shortest = std::min(shortest, (block.col(k) - block.col((k + 1) % block.cols())).norm());
      if (shortest > least_edge) add_block(scene, block);
    }
  return scene;
}

Scene loose_heap(int n) {
  return voronoi_heap(n, 0.05);
}

Scene heap(int n) {
  return voronoi_heap(n);
}

}  // namespace

Scene brick_wall(int n) {
  Scene scene = rock_scene();
  const int side = whole_root(n);
  add_bond(scene, side, side, brick_length, brick_height, box);
  return scene;
}

Scene gliding_wall(int n) {
  constexpr double dip = 20 * degree, friction_angle_of_floor = 10;
  Scene scene = brick_wall(n);
  const double gravity = scene.analysis.gravity.norm();
  scene.analysis.gravity = gravity * Vec2(std::sin(dip), -std::cos(dip));
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].name = "floor";
  scene.blocks[0].material = 1;
  Joint smooth;
  smooth.friction_angle = friction_angle_of_floor;
  smooth.between = {0, 1};
  scene.joints.push_back(smooth);
  return scene;
}

Scene long_polygons(int n) {
  Scene scene = rock_scene();
  const int n_columns = whole_root(n / 4.), n_rows = 4 * n_columns;
  add_bond(scene, n_rows, n_columns, 4, 0.5, rounded_box);
  return scene;
}

Scene arch(int n) {
  const double radius = n / std::numbers::pi, inner = 0.9 * radius, outer = 1.1 * radius;
  Scene scene = rock_scene();
  for (const double x : {-radius, radius})
    add_block(scene, box(x - 0.2 * radius, -0.2 * radius, x + 0.2 * radius, 0), true);
  const auto at = [&](int joint) {
    const double angle = std::numbers::pi * joint / n;
    return Vec2(joint == n ? -1 : joint == 0 ? 1 : std::cos(angle), joint % n == 0 ? 0 : std::sin(angle));
  };
  for (int k = 0; k < n; ++k) {
    Points voussoir(2, 4);
    voussoir << inner * at(k), outer * at(k), outer * at(k + 1), inner * at(k + 1);
    add_block(scene, voussoir);
  }
  return scene;
}

Scene voronoi_heap(int n, double gap) {
  const double side = std::sqrt(n);
  Scene scene = rock_scene();
  add_block(scene, box(-1, -1, side + 1, 0), true);
  add_block(scene, box(-1, 0, 0, side), true);
  add_block(scene, box(side, 0, side + 1, side), true);
  polyfem::VoronoiOptions options;
  options.n_cells = n;
  const polyfem::PolygonMesh mesh = polyfem::voronoi(box(0, 0, side, side), options);
  for (int c = 0; c < mesh.n_cells(); ++c) {
    Points cell = mesh.outline(c);
    if (gap > 0) {
      const Vec2 centroid = polyfem::area_moments(cell).centroid;
      cell = ((1 - gap) * (cell.colwise() - centroid)).colwise() + centroid;
    }
    add_block(scene, cell);
  }
  return scene;
}

Scene smooth_heap(int n) {
  Scene scene = voronoi_heap(n);
  scene.joints[0].friction_angle = 0;
  return scene;
}

Scene jointed_slope(int n) {
  return slope_with(n, 35);
}

Scene sliding_slope(int n) {
  return slope_with(n, 15);
}

Scene falling_polygons(int n) {
  constexpr double shrunk = 0.15, height_of_fall = 1;
  Scene scene = voronoi_heap(n, shrunk);
  const double wall = 2 * whole_root(n);
  for (int side : {1, 2}) scene.blocks[side].vertices.row(1).tail(2).setConstant(wall);
  for (std::size_t b = 3; b < scene.blocks.size(); ++b)
    scene.blocks[b].vertices.row(1).array() += height_of_fall;
  return scene;
}

Scene tunnel(int n) {
  constexpr double part_of_side = 0.15;
  Scene scene = voronoi_heap(n);
  const double side = std::sqrt(n);
  std::erase_if(scene.blocks, [&](const BlockDescription& block) {
    const Vec2 from_axis = polyfem::area_moments(block.vertices).centroid - 0.5 * Vec2(side, side);
    return !block.fixed && from_axis.norm() < part_of_side * side;
  });
  return scene;
}

Scene filled_arch(int n) {
  constexpr double springing = 30 * degree, thickness = 0.15;
  const int n_voussoirs = std::max(2, n / 2);
  const double radius = n_voussoirs / (std::numbers::pi - 2 * springing), outer = (1 + thickness) * radius,
               crown = outer + 0.1 * radius;
  const auto at = [&](int joint) {
    const double angle = springing + (std::numbers::pi - 2 * springing) * joint / n_voussoirs;
    return Vec2(std::cos(angle), std::sin(angle));
  };
  Scene scene = rock_scene();
  for (int end : {0, n_voussoirs}) {
    const Vec2 inside = radius * at(end), outside = outer * at(end);
    const double far = end == 0 ? 2 * radius : -2 * radius, foot = inside.y() - 0.5 * radius;
    Points springer(2, 5);
    springer << inside.x(), inside.x(), far, far, outside.x(),  //
        inside.y(), foot, foot, outside.y(), outside.y();
    if (end != 0) springer = springer.rowwise().reverse().eval();
    add_block(scene, springer, true);
    add_block(scene, box(std::min(far, outside.x()), outside.y(), std::max(far, outside.x()), crown), true);
  }
  for (int k = 0; k < n_voussoirs; ++k) {
    Points voussoir(2, 4), fill(2, 4);
    const Vec2 right = outer * at(k), left = outer * at(k + 1);
    voussoir << radius * at(k), right, left, radius * at(k + 1);
    fill << left, right, Vec2(right.x(), crown), Vec2(left.x(), crown);
    add_block(scene, voussoir);
    add_block(scene, fill);
  }
  return scene;
}

Scene rain(int n) {
  constexpr double spacing = 2, size = 0.6;
  Scene scene = rock_scene();
  std::mt19937 random(1);
  const auto uniform = [&](double most) { return most * (2 * (random() / 4294967296.) - 1); };
  const int side = whole_root(n);
  add_block(scene, box(-spacing, -1001, (side + 1) * spacing, -1000), true);
  for (int k = 0; k < side * side; ++k) {
    const int row = k / side, column = k % side;
    const Vec2 centre(spacing * column, spacing * row);
    const double turn = uniform(std::numbers::pi);
    Points pentagon(2, 5);
    for (int v = 0; v < 5; ++v) {
      const double angle = turn + 72 * degree * v;
      pentagon.col(v) = centre + size * Vec2(std::cos(angle), std::sin(angle));
    }
    BlockDescription& block = add_block(scene, pentagon);
    block.velocity = Vec2(uniform(0.2), uniform(0.2));
    block.angular_velocity = uniform(1);
  }
  return scene;
}

Scene field_with_mover(int n) {
  constexpr double spacing = 2, storey = 4;
  Scene scene = rock_scene();
  scene.materials.push_back({"slider", 2500, 10e9, 0.2});
  Joint slippery;
  slippery.friction_angle = 5;
  slippery.between = {0, 1};
  scene.joints.push_back(slippery);
  const int per_shelf = std::max(10, whole_root(n)), n_shelves = (n + per_shelf - 1) / per_shelf;
  const auto add_shelf = [&](int shelf) {
    add_block(scene, box(-spacing, shelf * storey - 1, per_shelf * spacing, shelf * storey), true);
  };
  for (int k = 0; k < n; ++k) {
    const int shelf = k / per_shelf, place = k % per_shelf;
    if (place == 0) add_shelf(shelf);
    const double left = place * spacing, bottom = shelf * storey;
    add_block(scene, box(left, bottom, left + brick_length, bottom + brick_height));
  }
  add_shelf(n_shelves);
  BlockDescription& mover =
      add_block(scene, box(0, n_shelves * storey, brick_length, n_shelves * storey + brick_height));
  mover.material = 1;
  mover.velocity = Vec2(1, 0);
  return scene;
}

std::span<const SceneKind> scene_kinds() {
  static constexpr std::array kinds{SceneKind{"wall", brick_wall},
                                    SceneKind{"glide", gliding_wall},
                                    SceneKind{"arch", arch},
                                    SceneKind{"heap", heap},
                                    SceneKind{"loose_heap", loose_heap},
                                    SceneKind{"smooth_heap", smooth_heap},
                                    SceneKind{"slope", jointed_slope},
                                    SceneKind{"slide", sliding_slope},
                                    SceneKind{"bin", falling_polygons},
                                    SceneKind{"tunnel", tunnel},
                                    SceneKind{"filled_arch", filled_arch},
                                    SceneKind{"rain", rain},
                                    SceneKind{"field", field_with_mover},
                                    SceneKind{"columns", long_polygons}};
  return kinds;
}

Scene make_scene(const std::string& kind, int n) {
  for (const SceneKind& known : scene_kinds())
    if (kind == known.name) return known.make(n);
  throw Error("there is no scene \"" + kind + "\"");
}

void set_time_step(Scene& scene, double time_step) {
  scene.analysis.time_step = time_step;
  scene.analysis.steps = 1;  // a stepper goes on after those of the last stage
}

void settle_first(Scene& scene) {
  StageDescription settle = scene.stage("settle");
  settle.analysis.mode = Mode::statics;
  settle.analysis.time_step = settling_step;
  settle.analysis.steps = n_settling_steps;
  scene.stages = {settle, scene.stage("measured")};
}

void make_classic(Scene& scene) {
  AnalysisOptions& analysis = scene.analysis;
  analysis.preset = Preset::paper;
  analysis.kinematics = Kinematics::incremental;
  analysis.scheme = Scheme::dda;
  analysis.gradient_correction = GradientCorrection::off;
  analysis.cutting_factor = 0.3;
  scene.contact.method = ContactMethod::classic;
  scene.contact.penetration_tolerance = 0;
  for (BlockDescription& block : scene.blocks) block.model = BlockModel::affine;
}

}  // namespace performance
