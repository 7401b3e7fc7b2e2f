/// \file Voronoi blocks on a slope: stresses at rest, and how they slide.
#include <tests/performance/error_time/problem.hpp>

#include <ddacontact/output/block_summary.hpp>
#include <mechanics_scenes.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <cmath>

namespace error_time {

using namespace verification;

namespace {

constexpr int n_cells = 30, settling_steps = 20, reference_steps = 8, reference_cells = 16;
constexpr double slope = 25, friction_angle = 15;                   // degrees
constexpr double settling_step = 0.5, duration = 0.1, young = 1e9;  // s, s, Pa
constexpr double reference_step = 5e-4;

/// Block 0 is the slope.
Scene pile(double time_step, int steps) {
  Scene scene = rock_scene(time_step, steps, young);
  scene.joints[0].friction_angle = friction_angle;
  scene.blocks = {block(turned(rectangle(-20, -1, 40, 1), -radians(slope)), true)};
  const polyfem::PolygonMesh cells = polyfem::voronoi(rectangle(0, 0, 6, 3), {.n_cells = n_cells});
  for (int c = 0; c < cells.n_cells(); ++c)
    scene.blocks.push_back(block(turned(cells.outline(c), -radians(slope))));
  return scene;
}

Scene resting_scene(const Method& method, double n_steps) {
  Scene scene = pile(settling_step, 0);
  apply(method, scene);
  settle_first(scene, static_cast<int>(n_steps), settling_step);
  scene.stages.pop_back();
  return scene;
}

Scene sliding_scene(const Method& method, double time_step) {
  Scene scene = pile(time_step, static_cast<int>(std::lround(duration / time_step)));
  apply(method, scene);
  settle_first(scene, settling_steps, settling_step);
  scene.stages[0].reset_displacements = true;
  return scene;
}

/// The blocks' mean stresses, a column for each that may move, by the root of its area.
Eigen::Matrix3Xd stresses(const Stepper& stepper) {
  const BlockSystem& blocks = stepper.blocks();
  Eigen::Matrix3Xd found(3, blocks.n_blocks() - 1);
  for (int b = 1; b < blocks.n_blocks(); ++b)
    found.col(b - 1) =
        std::sqrt(blocks.block(b).reference_area()) * mean_stress(blocks.block(b), stepper.state());
  return found;
}

/// How far the middles of the blocks have come since they were let go: the mean of their outlines' vertices.
Points ways(const Stepper& stepper) {
  const BlockSystem& blocks = stepper.blocks();
  const Points displacements = blocks.displacements(stepper.state());
  Points found(2, blocks.n_blocks() - 1);
  for (int b = 1; b < blocks.n_blocks(); ++b) {
    const auto [first, count] = blocks.block(b).vertices();
    found.col(b - 1) = displacements.middleCols(first, count).rowwise().mean();
  }
  return found;
}

Judge resting_judge() {
  Method fine = method_of("mesh");
  fine.penetration_tolerance = 1e-8;
  Scene scene = resting_scene(fine, reference_steps);
  for (BlockDescription& block : scene.blocks) block.mesh.cells = reference_cells;
  const BuiltScene built = run(scene);
  return [expected = stresses(*built.stepper)](const Stepper& stepper) {
    return std::vector{(stresses(stepper) - expected).norm() / expected.norm()};
  };
}

Judge sliding_judge() {
  Method fine = method_of("tolerance 1e-8");
  const BuiltScene built = run(sliding_scene(fine, reference_step));
  return [expected = ways(*built.stepper)](const Stepper& stepper) {
    return std::vector{(ways(stepper) - expected).norm() / expected.norm()};
  };
}

}  // namespace

Problem resting_slope() {
  return {
      .name = "resting_slope",
      .title = "Voronoi blocks on a slope, at rest",
      .description =
          "30 Voronoi cells of a rectangle of 6 x 3 m, E = 1 GPa, on a rigid slope of 25 degrees get their "
          "weight "
          "at once, with a friction angle of 45 degrees; static steps of 0.5 s. The blocks' mean stresses "
          "(root of the sum over their areas of the squares) against 16 cells in every block, penetration to "
          "1e-8 and 8 steps: `mesh` has the same cells, so that its error is that of its steps alone.",
      .quantities = {{"slope_stress", "error of the blocks' mean stresses"}},
      .setting = "static steps",
      .settings = {1, 2, 4, 8, 16},
      .scene = resting_scene,
      .judge = resting_judge,
      .is_static = true};
}

Problem sliding_slope() {
  return {
      .name = "sliding_slope",
      .title = "Voronoi blocks that slide",
      .description =
          "The same blocks, settled in 20 steps, are let go by a friction angle of 15 degrees. How far they "
          "have "
          "come after 0.1 s (root of the sum of the squares) against the default with steps of 5e-4 s and "
          "penetration to 1e-8.",
      .quantities = {{"slope_ways", "error of the blocks' ways"}},
      .setting = "Δt, s",
      .settings = {0.02, 0.01, 0.005, 0.002},
      .scene = sliding_scene,
      .judge = sliding_judge,
      .settles = true};
}

}  // namespace error_time
