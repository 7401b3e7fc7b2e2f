/// \file Sliding with and against an initial velocity.
#include "chapters.hpp"
#include "slider.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace validation {

namespace {

constexpr double duration = 2, resting_time = 1;  // s; of these the last may be at rest
constexpr double time_steps[] = {0.02, 0.01, 0.005, 0.002, 0.001};

/// A rigid block that starts down the slope at `velocity`, or up when that is negative.
struct Motion {
  double turning_time = std::numeric_limits<double>::infinity();  ///< when it first is at rest
  double turning_way = 0, final_way = 0;                          ///< m, down the slope
  bool rests = false;
};

Motion rigid_motion(double slope, double friction, double velocity) {
  const double pull = gravity * std::sin(slope), drag = gravity * std::cos(slope) * friction;
  const double acceleration = pull - std::copysign(drag, velocity);
  Motion motion;
  if (velocity * acceleration >= 0) {
    motion.final_way = velocity * duration + acceleration * duration * duration / 2;
    return motion;
  }
  motion.turning_time = -velocity / acceleration;
  motion.turning_way = -velocity * velocity / (2 * acceleration);
  motion.rests = drag >= pull;
  const double after = duration - motion.turning_time;
  motion.final_way = motion.turning_way + (motion.rests ? 0 : (pull - drag) * after * after / 2);
  return motion;
}

/// The same of the computed block, with its history.
struct Computed {
  Motion motion;
  double creep = 0;  ///< m, over the last half second
  Series velocity;
};

Computed compute(const Slider& slider, double start_velocity) {
  const BuiltScene built = settled(slider_scene(slider));
  Stepper& stepper = *built.stepper;
  const Block& block = stepper.blocks().block(1);
  StepRecord record = stepper.record();
  record.state.velocity.segment(block.unknowns().first, block.unknowns().count) =
      start_velocity * block.rigid_modes().leftCols<2>() * slider.down();
  stepper.restore(std::move(record));

  Computed computed;
  const double start = travel(stepper, 1).dot(slider.down());
  const int n = static_cast<int>(std::lround(slider.duration / slider.time_step));
  double last = start_velocity, half_second_ago = 0, way = 0;
  for (int k = 1; k <= n; ++k) {
    run(stepper, 1);
    way = travel(stepper, 1).dot(slider.down()) - start;
    const double now = velocity(stepper, 1).dot(slider.down());
    computed.velocity.x.push_back(stepper.state().time);
    computed.velocity.y.push_back(now);
    computed.motion.turning_way =
        start_velocity < 0 ? std::min(computed.motion.turning_way, way) : std::max(computed.motion.turning_way, way);
    if (now * start_velocity > 0 && now != last && computed.motion.turning_time > stepper.state().time)
      computed.motion.turning_time = stepper.state().time + now * slider.time_step / (last - now);
    fmt::print(stderr, "");
    last = now;
    if (k == n - static_cast<int>(std::lround(0.5 / slider.time_step))) half_second_ago = way;
  }
  computed.motion.final_way = way;
  computed.creep = std::abs(way - half_second_ago);
  return computed;
}

struct Case {
  double slope, friction, velocity;  // degrees, degrees, m/s
};
constexpr Case cases[] = {{20, 12, 1.5}, {20, 31, 2}, {20, 12, -2.5}, {20, 31, -3},
                          {35, 28, 1.5}, {35, 41, 1}, {35, 28, -4},   {35, 41, -5}};

}  // namespace

void velocities(Report& report) {
  report.heading("2. Sliding with and against an initial velocity");
  std::vector<std::vector<std::string>> rows{{"slope", "φ", "start, m/s", "Δt, s", "turn at, s", "err", "turn way", "err", "final", "err", "creep"}};
  for (const Case& of : cases)
    for (const double time_step : time_steps) {
      const Slider slider{.angle = radians(of.slope), .friction = std::tan(radians(of.friction)), .time_step = time_step, .duration = duration};
      const Motion exact = rigid_motion(slider.angle, slider.friction, of.velocity);
      const Computed seen = compute(slider, of.velocity);
      rows.push_back({text(of.slope), text(of.friction), text(of.velocity), text(time_step), text(exact.turning_time),
                      text(seen.motion.turning_time - exact.turning_time), text(exact.turning_way),
                      text(seen.motion.turning_way - exact.turning_way), text(exact.final_way),
                      text(seen.motion.final_way - exact.final_way), text(seen.creep)});
    }
  report.table(rows);
}

}  // namespace validation
