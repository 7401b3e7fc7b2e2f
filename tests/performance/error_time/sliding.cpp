/// \file A block that slides down a plane under its weight and a force along the plane that sways.
#include <tests/performance/error_time/problem.hpp>

#include <mechanics_scenes.hpp>

#include <cmath>

namespace error_time {

using namespace verification;

namespace {

constexpr double slope = 30, friction = 20;              // degrees
constexpr double settling_time = 2, duration = 1;        // s
constexpr double amplitude = 1.5, pulsation = 2 * turn;  // m/s2, rad/s
constexpr int settling_steps = 20, slider = 1;

Vec2 down() {
  return {std::cos(radians(slope)), -std::sin(radians(slope))};
}

Load swaying(double density) {
  constexpr double entry = 1e-4;  // s
  Load load;
  load.kind = Load::Kind::body;
  load.block = slider;
  load.force.kind = TimeFunction::Kind::history;
  for (double t = 0; t < duration + 0.1; t += entry) {
    const Vec2 force = density * amplitude * std::sin(pulsation * t) * down();
    load.force.history.emplace_back(settling_time + t, force.x(), force.y());
  }
  return load;
}

Scene scene(const Method& method, double time_step) {
  Scene scene = rock_scene(time_step, static_cast<int>(std::lround(duration / time_step)));
  scene.joints[0].friction_angle = friction;
  scene.blocks = {block(turned(rectangle(-20, -1, 80, 1), -radians(slope)), true),
                  block(turned(rectangle(0, 0, 3, 1.5), -radians(slope)))};
  scene.loads = {swaying(scene.materials[0].density)};
  apply(method, scene);
  settle_first(scene, settling_steps, settling_time / settling_steps);
  return scene;
}

Judge judge() {
  const double steady =
      gravity * (std::sin(radians(slope)) - std::cos(radians(slope)) * std::tan(radians(friction)));
  const double phase = pulsation * duration;
  const double exact =
      steady * duration * duration / 2 + amplitude / (pulsation * pulsation) * (phase - std::sin(phase));
  return [exact](const Stepper& stepper) {
    return std::vector{std::abs(way(stepper, slider).dot(down()) / exact - 1)};
  };
}

}  // namespace

Problem sliding() {
  return {
      .name = "sliding",
      .title = "A block that slides",
      .description =
          "A block of 3 x 1.5 m, E = 35 GPa, has settled on a plane of 30 degrees and slides with a friction "
          "angle of 20 degrees under a force along the plane of 1.5 m/s2 sin 4πt. Its way after one second "
          "is "
          "known: a t²/2 + A (ωt − sin ωt)/ω².",
      .quantities = {{"sliding", "error of the way after one second"}},
      .setting = "Δt, s",
      .settings = {0.05, 0.02, 0.01, 0.005, 0.0025, 0.00125},
      .scene = scene,
      .judge = judge,
      .settles = true};
}

}  // namespace error_time
