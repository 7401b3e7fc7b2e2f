/// \file A block that slides down a plane under its weight and a force along the plane that sways.
#include <tests/performance/error_time/problem.hpp>
#include <tests/performance/error_time/swaying.hpp>

#include <mechanics_scenes.hpp>

#include <cmath>

namespace error_time {

using namespace verification;

namespace {

constexpr SwayingSlide slide{.slope = 30, .friction = 20};
constexpr double settling_time = 2, duration = 1;  // s
constexpr int settling_steps = 20, slider = 1;

Scene scene(const Method& method, double time_step) {
  Scene scene = rock_scene(time_step, static_cast<int>(std::lround(duration / time_step)));
  scene.joints[0].friction_angle = slide.friction;
  scene.blocks = {block(turned(rectangle(-20, -1, 80, 1), -radians(slide.slope)), true),
                  block(turned(rectangle(0, 0, 3, 1.5), -radians(slide.slope)))};
  scene.loads = {slide.force(slider, scene.materials[0].density, settling_time, duration)};
  apply(method, scene);
  settle_first(scene, settling_steps, settling_time / settling_steps);
  return scene;
}

Judge judge() {
  return [](const Stepper& stepper) {
    return std::vector{std::abs(way(stepper, slider).dot(slide.down()) / slide.way(duration) - 1)};
  };
}

}  // namespace

Problem sliding() {
  return {
      .name = "sliding",
      .title = "A block that slides",
      .description =
          "A block of 3 x 1.5 m, E = 35 GPa, has settled on a plane of 30 degrees. It slides with a friction "
          "angle of 20 degrees under a force along the plane of 1.5 m/s2 sin 4πt. Its way after one second "
          "is known: a t²/2 + A (ωt − sin ωt)/ω².",
      .quantities = {{"sliding", "error of the way after one second"}},
      .setting = "Δt, s",
      .settings = {0.05, 0.02, 0.01, 0.005, 0.0025, 0.00125},
      .scene = scene,
      .judge = judge,
      .settles = true};
}

}  // namespace error_time
