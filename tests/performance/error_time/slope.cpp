/// \file Voronoi blocks on a slope: stresses at rest, and how they slide.
#include <tests/performance/error_time/problem.hpp>
#include <tests/performance/error_time/swaying.hpp>

#include <ddacontact/output/block_summary.hpp>
#include <mechanics_scenes.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <cmath>

namespace error_time {

using namespace verification;

namespace {

constexpr int resting_cells = 30, sliding_cells = 8, settling_steps = 20, reference_steps = 8,
              reference_cells = 16;
constexpr SwayingSlide slide{.slope = 25, .friction = 15};
constexpr double friction_between = 40;              // degrees
constexpr double settling_step = 0.5, duration = 1;  // s

/// Cells of a rectangle that lies on the slope, block 0.
Scene pile(double width, double height, int n_cells, double young) {
  Scene scene = rock_scene(settling_step, 0, young);
  scene.blocks = {block(turned(rectangle(-20, -1, 40, 1), -radians(slide.slope)), true)};
  const polyfem::PolygonMesh cells = polyfem::voronoi(rectangle(0, 0, width, height), {.n_cells = n_cells});
  for (int c = 0; c < cells.n_cells(); ++c)
    scene.blocks.push_back(block(turned(cells.outline(c), -radians(slide.slope))));
  return scene;
}

Scene resting_scene(const Method& method, double n_steps) {
  Scene scene = pile(6, 3, resting_cells, 1e9);
  apply(method, scene);
  settle_first(scene, static_cast<int>(n_steps), settling_step);
  scene.stages.pop_back();
  return scene;
}

Scene sliding_scene(const Method& method, double time_step) {
  Scene scene = pile(3, 2, sliding_cells, 35e9);
  scene.analysis.time_step = time_step;
  scene.analysis.steps = static_cast<int>(std::lround(duration / time_step));
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].name = "slope";
  scene.blocks[0].material = 1;
  scene.joints[0].friction_angle = friction_between;
  scene.joints.push_back(scene.joints[0]);
  scene.joints[1].between = {0, 1};
  scene.joints[1].friction_angle = slide.friction;
  for (int b = 1; b < static_cast<int>(scene.blocks.size()); ++b)
    scene.loads.push_back(
        slide.force(b, scene.materials[0].density, settling_steps * settling_step, duration));
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

/// How far the centre of mass of all has come down the slope since they were let go, m.
double way_down(const Stepper& stepper) {
  const BlockSystem& blocks = stepper.blocks();
  double sum = 0, area = 0;
  for (int b = 1; b < blocks.n_blocks(); ++b) {
    sum += blocks.block(b).reference_area() * way(stepper, b).dot(slide.down());
    area += blocks.block(b).reference_area();
  }
  return sum / area;
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
  return [](const Stepper& stepper) {
    return std::vector{std::abs(way_down(stepper) / slide.way(duration) - 1)};
  };
}

}  // namespace

Problem resting_slope() {
  return {
      .name = "resting_slope",
      .title = "Voronoi blocks on a slope, at rest",
      .description =
          "30 Voronoi cells of a rectangle of 6 x 3 m, E = 1 GPa, on a rigid slope of 25 degrees get their "
          "weight at once. They have a friction angle of 45 degrees; static steps of 0.5 s. The blocks' mean "
          "stresses (root of the sum over their areas of the squares) against 16 cells in every block, "
          "penetration to 1e-8 and 8 steps. `mesh` has the same cells, so that its error is that of its "
          "steps alone. Friction at rest may be shared out in more than one way: errors of a few per cent do "
          "not tell models apart.",
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
          "8 Voronoi cells of a rectangle of 3 x 2 m, E = 35 GPa, have settled on a rigid slope of 25 "
          "degrees. With a friction angle of 40 degrees between them and 15 on the slope they slide as one "
          "under a force along it of 1.5 m/s2 sin 4πt on all of them. How far their centre of mass has come "
          "after one second is known, as that of the block above is.",
      .quantities = {{"slope_way", "error of the way of the blocks' centre of mass"}},
      .setting = "Δt, s",
      .settings = {0.05, 0.02, 0.01, 0.005, 0.0025, 0.00125},
      .scene = sliding_scene,
      .judge = sliding_judge,
      .settles = true};
}

}  // namespace error_time
