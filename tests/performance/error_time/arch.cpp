/// \file A semicircular arch of voussoirs under its own weight.
#include <tests/performance/error_time/problem.hpp>

#include <mechanics_scenes.hpp>

#include <cmath>
#include <numbers>

namespace error_time {

using namespace verification;

namespace {

constexpr int n_voussoirs = 15, crown = 2 + n_voussoirs / 2;     // blocks 0 and 1 are the abutments
constexpr double radius = 10, thickness = 1.5, time_step = 0.5;  // m, s
constexpr double young = 1e9, friction_angle = 35;
constexpr int reference_steps = 6, reference_cells = 144;

Scene scene(const Method& method, double n_steps) {
  Scene scene = rock_scene(time_step, static_cast<int>(n_steps), young);
  scene.analysis.mode = Mode::statics;
  scene.joints[0].friction_angle = friction_angle;
  const double inner = radius - thickness / 2, outer = radius + thickness / 2;
  scene.blocks = {block(rectangle(inner - 1, -1, thickness + 2, 1), true),
                  block(rectangle(-outer - 1, -1, thickness + 2, 1), true)};
  for (int k = 0; k < n_voussoirs; ++k) {
    const double from = std::numbers::pi * k / n_voussoirs, to = std::numbers::pi * (k + 1) / n_voussoirs;
    const Vec2 a(std::cos(from), std::sin(from)), b(std::cos(to), std::sin(to));
    Points voussoir(2, 4);
    voussoir << inner * a, outer * a, outer * b, inner * b;
    scene.blocks.push_back(block(voussoir));
  }
  apply(method, scene);
  return scene;
}

/// m, down.
double sinking(const Stepper& stepper) {
  return -way(stepper, crown).y();
}

/// The horizontal force on an abutment, N per m.
double thrust(const Stepper& stepper) {
  const auto [first, count] = stepper.blocks().block(0).vertices();
  return stepper.reactions().row(0).segment(first, count).sum();
}

Judge judge() {
  Method fine = method_of("mesh");
  fine.penetration_tolerance = 1e-9;
  Scene reference = scene(fine, reference_steps);
  for (BlockDescription& block : reference.blocks) block.mesh.cells = reference_cells;
  const BuiltScene built = run(reference);
  return [sunk = sinking(*built.stepper), thrusts = thrust(*built.stepper)](const Stepper& stepper) {
    return std::vector{std::abs(sinking(stepper) / sunk - 1), std::abs(thrust(stepper) / thrusts - 1)};
  };
}

}  // namespace

Problem arch() {
  return {.name = "arch",
          .title = "An arch under its weight",
          .description =
              "A semicircular arch of 15 voussoirs, 10 m of mean radius and 1.5 m thick, gets its weight at "
              "once. E = 1 GPa, friction angle 35 degrees; static steps of 0.5 s. How far the crown sinks "
              "and the thrust on an abutment, against 144 cells in every voussoir, penetration to 1e-9 and 6 "
              "steps.",
          .quantities = {{"arch_sinking", "error of how far the crown sinks"},
                         {"arch_thrust", "error of the thrust"}},
          .setting = "static steps",
          .settings = {1, 2, 4, 8, 16},
          .scene = scene,
          .judge = judge,
          .is_static = true};
}

}  // namespace error_time
