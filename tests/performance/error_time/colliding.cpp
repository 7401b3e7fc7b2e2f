/// \file A square turned by 45 degrees hits the face of a free block off its middle.
#include <tests/performance/error_time/problem.hpp>

#include <mechanics_scenes.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace error_time {

using namespace verification;

namespace {

constexpr double side = 0.5, thickness = 0.8, height = 1.6, offset = 0.55;  // m
constexpr double density = 2500;
constexpr double duration = 0.1, time_of_hit = 0.03737;  // s
const Vec2 speed(3, 0.4);                                // of the square

/// What rigid blocks without friction do, with all of the speed of approach given back.
struct Rigid {
  Vec2 travel;       ///< m, after `duration`
  double turned;     ///< rad
  double half_size;  ///< m
};

std::array<Rigid, 2> rigid_blocks() {
  const double m1 = density * side * side, m2 = density * thickness * height;
  const double inertia = m2 * (thickness * thickness + height * height) / 12;
  const double impulse = 2 * speed.x() / (1 / m1 + 1 / m2 + offset * offset / inertia);
  const double after = duration - time_of_hit;
  return {Rigid{speed * duration - Vec2(impulse / m1 * after, 0), 0, side / 2},
          Rigid{Vec2(impulse / m2 * after, 0), -offset * impulse / inertia * after, height / 2}};
}

Scene scene(const Method& method, double time_step) {
  Scene scene = rock_scene(time_step, static_cast<int>(std::lround(duration / time_step)));
  scene.analysis.gravity.setZero();
  scene.materials[0].density = density;
  if (!method.paper) scene.joints[0].restitution = 1;
  Points square = turned(rectangle(-side / 2, -side / 2, side, side), turn / 8);
  square.colwise() += Vec2(-side / std::sqrt(2), offset) - time_of_hit * speed;
  scene.blocks = {block(square), block(rectangle(0, -height / 2, thickness, height))};
  scene.blocks[0].velocity = speed;
  apply(method, scene);
  return scene;
}

/// By which the first edge has turned.
double rotation(const Stepper& stepper, int b) {
  const int first = stepper.blocks().block(b).vertices().first;
  const Points now = stepper.blocks().positions(stepper.state()), before = stepper.blocks().reference();
  const Vec2 was = before.col(first + 1) - before.col(first), is = now.col(first + 1) - now.col(first);
  return std::atan2(was.x() * is.y() - was.y() * is.x(), was.dot(is));
}

double error(const Stepper& stepper) {
  const std::array<Rigid, 2> rigid = rigid_blocks();
  double largest = 0;
  for (int b = 0; b < 2; ++b) {
    const Rigid& expected = rigid[static_cast<std::size_t>(b)];
    largest = std::max({largest, (way(stepper, b) - expected.travel).norm(),
                        expected.half_size * std::abs(rotation(stepper, b) - expected.turned)});
  }
  return largest / (speed.x() * (duration - time_of_hit));
}

Judge judge() {
  return [](const Stepper& stepper) { return std::vector{error(stepper)}; };
}

}  // namespace

Problem colliding() {
  return {
      .name = "colliding",
      .title = "A collision",
      .description =
          "A square of 0.5 m flies with a corner against the face of a block of 0.8 x 1.6 m, 0.55 m off its "
          "middle. There is no friction and no gravity; E = 35 GPa. All of the speed of approach is given "
          "back (`restitution = 1`; of `paper` and `classic` nothing can be asked). Where the blocks are and "
          "how far they have turned 63 ms after the hit, against rigid ones, over the way that the square "
          "would have made.",
      .quantities = {{"colliding", "error of the places after the hit"}},
      .setting = "Δt, s",
      .settings = {0.02, 0.01, 0.005, 0.002, 0.001, 5e-4, 2e-4, 5e-5},
      .scene = scene,
      .judge = judge};
}

}  // namespace error_time
