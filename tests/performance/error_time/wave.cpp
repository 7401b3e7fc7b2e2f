/// \file A pressure wave along a bar of bonded blocks.
#include <tests/performance/error_time/problem.hpp>

#include <mechanics_scenes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace error_time {

using namespace verification;

namespace {

constexpr double length = 20, pressure = 20e6;                  // m, Pa
constexpr double density = 2500, young = 35e9, poisson = 0.25;  // kg/m3, Pa
constexpr double front = 0.75 * length;                         // m, at the end
const double speed =
    std::sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / density);  // sqrt((λ + 2μ)/ρ)
const double behind = pressure / (density * speed);                                    // m/s

/// In as many steps as there are blocks the front comes to three quarters of the bar.
Scene scene(const Method& method, double n_blocks) {
  const int n = static_cast<int>(n_blocks);
  const double size = length / n;
  Scene scene = rock_scene(front / speed / n, n, young);
  scene.materials = {{"rock", density, young, poisson}};
  scene.analysis.gravity.setZero();
  scene.joints[0] = {"bond", 45, 1e12, 1e12, std::nullopt};
  for (int b = 0; b < n; ++b) {
    scene.blocks.push_back(block(rectangle(b * size, 0, size, size)));
    Support roller;
    roller.block = b;
    roller.vertices = {0, 1, 2, 3};
    roller.fix_x = false;
    scene.supports.push_back(roller);
  }
  Load push;
  push.kind = Load::Kind::pressure;
  push.edge = 3;
  push.force.value.x() = pressure;
  scene.loads = {push};
  apply(method, scene);
  return scene;
}

/// Where half the velocity behind the front is passed, seen from the far end, between middles of blocks.
double arrival_error(const Stepper& stepper) {
  const int n = stepper.blocks().n_blocks();
  for (int b = n - 1; b > 0; --b) {
    const double v = velocity(stepper, b - 1).x(), next = velocity(stepper, b).x();
    if (v < behind / 2) continue;
    const double at = (b - 0.5 + (v - behind / 2) / (v - next)) * length / n;
    return std::abs(at / front - 1);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double profile_error(const Stepper& stepper) {
  const int n = stepper.blocks().n_blocks();
  double sum = 0;
  for (int b = 0; b < n; ++b)
    sum += std::abs(velocity(stepper, b).x() / behind - ((b + 0.5) * length / n < front ? 1 : 0));
  return sum / n;
}

Judge judge() {
  return [](const Stepper& stepper) { return std::vector{arrival_error(stepper), profile_error(stepper)}; };
}

}  // namespace

Problem wave() {
  return {
      .name = "wave",
      .title = "A wave along a bar of blocks",
      .description =
          "A bar of 20 m made of 12 to 192 bonded squares, held sideways, E = 35 GPa, ν = 0.25, is pushed at "
          "one end by 20 MPa from the start. A front runs along it at √((λ + 2μ)/ρ), behind it the bar moves "
          "at p/ρc. When it has come to three quarters of the bar, after as many steps as there are blocks, "
          "two errors are taken. The first is where half that velocity is passed, over the way of the front. "
          "The second is the mean over the blocks of the error of their velocities, over p/ρc.",
      .quantities = {{"wave_front", "error of the place of the front"},
                     {"wave_profile", "mean error of the velocity"}},
      .setting = "blocks",
      .settings = {12, 24, 48, 96, 192},
      .scene = scene,
      .judge = judge};
}

}  // namespace error_time
