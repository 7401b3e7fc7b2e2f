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

constexpr double duration = 2;  // s
constexpr double time_steps[] = {0.02, 0.01, 0.005, 0.002, 0.001};

/// How a block starts on its slope.
struct Case {
  double slope, friction;  ///< degrees
  double velocity;         ///< m/s, down the slope
};
constexpr Case cases[] = {{20, 12, 1.5}, {20, 31, 2}, {20, 12, -2.5}, {20, 31, -3},
                          {35, 28, 1.5}, {35, 41, 1}, {35, 28, -4},   {35, 41, -5}};

/// How it goes on, for two seconds.
struct Motion {
  double turning_time = std::numeric_limits<double>::infinity();  ///< when it first is at rest
  double turning_way = 0, final_way = 0;                          ///< m, down the slope
  bool rests = false;
};

Motion rigid_motion(const Case& of) {
  const double a = radians(of.slope), pull = gravity * std::sin(a),
               drag = gravity * std::cos(a) * std::tan(radians(of.friction));
  const double acceleration = pull - std::copysign(drag, of.velocity);
  Motion motion;
  if (of.velocity * acceleration >= 0) {
    motion.final_way = of.velocity * duration + acceleration * duration * duration / 2;
    return motion;
  }
  motion.turning_time = -of.velocity / acceleration;
  motion.turning_way = -of.velocity * of.velocity / (2 * acceleration);
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

Slider slider_of(const Case& of, double time_step) {
  return {.angle = radians(of.slope),
          .friction = std::tan(radians(of.friction)),
          .time_step = time_step,
          .duration = duration};
}

Computed compute(const Case& of, double time_step) {
  const Slider slider = slider_of(of, time_step);
  const BuiltScene built = settled(slider_scene(slider));
  Stepper& stepper = *built.stepper;
  const Block& block = stepper.blocks().block(1);
  StepRecord record = stepper.record();
  record.state.velocity.segment(block.unknowns().first, block.unknowns().count) =
      of.velocity * block.translations() * slider.down();
  stepper.restore(std::move(record));

  Computed computed;
  const double start = travel(stepper, 1).dot(slider.down());
  const int n = static_cast<int>(std::lround(duration / time_step)),
            late = n - static_cast<int>(std::lround(0.5 / time_step));
  double last = of.velocity, late_way = 0;
  for (int k = 1; k <= n; ++k) {
    run(stepper, 1);
    const double way = travel(stepper, 1).dot(slider.down()) - start,
                 time = stepper.state().time - settling_time, now = velocity(stepper, 1).dot(slider.down());
    Motion& motion = computed.motion;
    motion.turning_way =
        of.velocity < 0 ? std::min(motion.turning_way, way) : std::max(motion.turning_way, way);
    // It comes to rest where its deceleration of the last step that still goes on takes it.
    if (now * of.velocity > 0 && std::abs(now) < std::abs(last) && motion.turning_time > time)
      motion.turning_time = time + now * time_step / (last - now);
    if (motion.turning_time < time - time_step) motion.rests = std::abs(now) < 1e-9;
    last = now;
    if (k == late) late_way = way;
    motion.final_way = way;
    computed.velocity.x.push_back(time);
    computed.velocity.y.push_back(now);
  }
  computed.creep = std::abs(computed.motion.final_way - late_way);
  return computed;
}

std::string name(const Case& of) {
  return fmt::format("{:g}°, φ = {:g}°, {:+g} m/s", of.slope, of.friction, of.velocity);
}

void picture(Report& report) {
  Chart chart{
      .x_symbol = {"t", "", ""}, .y_symbol = {"v", "", ""}, .x_unit = "s", .y_unit = "m/s", .series = {}};
  for (const Case& of : cases) {
    if (of.slope != 35) continue;
    chart.series.push_back(compute(of, 0.01).velocity);
    chart.series.back().name = fmt::format("φ = {:g}°, {:+g} m/s", of.friction, of.velocity);
  }
  for (const Case& of : cases) {
    if (of.slope != 35) continue;
    const Motion motion = rigid_motion(of);
    const bool turns = std::isfinite(motion.turning_time);
    Series rigid{"rigid block", {0}, {of.velocity}, true};
    const double rest = turns ? motion.turning_time : 0;
    const double acceleration =
        turns && motion.rests ? 0 : slider_of(of, 0.01).acceleration();  // down, from rest or the start
    for (double t = 0.1; t < duration; t += 0.1) {
      rigid.x.push_back(t);
      rigid.y.push_back(t < rest ? of.velocity * (1 - t / rest)
                                 : (turns ? 0 : of.velocity) + acceleration * (t - rest));
    }
    chart.series.push_back(rigid);
  }
  report.picture(
      "dda_velocities", draw({chart}, {.title = "A block with an initial velocity", .plot_height = 260}),
      "Velocity down a slope of 35 degrees, m/s: computed with Δt = 0.01 s (lines) and of the rigid block "
      "(marks).");
}

}  // namespace

void velocities(Report& report) {
  report.heading("2. Sliding with and against an initial velocity");
  report.paragraph(
      "The block of chapter 1 at rest on its slope, E = 35 GPa, gets a velocity v₀ along it. While it moves, "
      "its acceleration is g (sin a ∓ cos a tan φ), friction against its way. Where that slows it down it "
      "comes to rest at t = −v₀/acceleration after −v₀²/(2 acceleration), and stays (tan φ > tan a) or turns "
      "back. The way where it turns, and the way after two seconds, by the formula and its error (m) for "
      "three steps. Then the largest error of the time of turning (s), and how far it creeps in the last "
      "half second (m):");
  std::vector<std::vector<std::string>> rows{{"slope, friction, velocity down", "turns at, s", "error",
                                              "after, m", "Δt = 0.02 s", "0.005 s", "0.001 s",
                                              "way in 2 s, m", "0.02 s", "0.005 s", "0.001 s", "creep"}};
  double time_error = 0, turning_error = 0, down_error = 0, resting_error = 0, creep = 0, back_error = 0;
  bool rests = true;
  for (const Case& of : cases) {
    const Motion exact = rigid_motion(of);
    const bool turns = std::isfinite(exact.turning_time);
    double of_time = 0, of_creep = 0;
    std::vector<std::string> ways, turnings;
    for (const double time_step : time_steps) {
      const Computed seen = compute(of, time_step);
      const double final_error = seen.motion.final_way - exact.final_way,
                   relative = std::abs(final_error / exact.final_way);
      if (turns) {
        const double off = std::abs(seen.motion.turning_time - exact.turning_time);
        of_time = std::max(of_time, off);
        time_error = std::max(time_error, off / time_step);
        turning_error = std::max(turning_error, std::abs(seen.motion.turning_way / exact.turning_way - 1));
      }
      rests = rests && (!turns || seen.motion.rests == exact.rests);
      if (!turns) {
        down_error = std::max(down_error, relative);
      } else if (exact.rests) {
        of_creep = std::max(of_creep, seen.creep);
        resting_error = std::max(resting_error, relative);
      } else {
        // Friction may act the wrong way for the rest of the step in which the block turns.
        const double wrong =
            2 * (gravity * std::sin(radians(of.slope)) - slider_of(of, time_step).acceleration());
        back_error = std::max(back_error,
                              std::abs(final_error) / (wrong * time_step * (duration - exact.turning_time)));
      }
      if (time_step == 0.02 || time_step == 0.005 || time_step == 0.001) {
        turnings.push_back(turns ? text(seen.motion.turning_way - exact.turning_way) : "");
        ways.push_back(text(final_error));
      }
    }
    creep = std::max(creep, of_creep);
    rows.push_back(
        {name(of), turns ? fmt::format("{:.4f}", exact.turning_time) : "never", turns ? text(of_time) : ""});
    std::vector<std::string>& row = rows.back();
    row.push_back(turns ? fmt::format("{:.4f}", exact.turning_way) : "");
    row.insert(row.end(), turnings.begin(), turnings.end());
    row.push_back(fmt::format("{:.4f}", exact.final_way));
    row.insert(row.end(), ways.begin(), ways.end());
    row.push_back(turns && exact.rests ? text(of_creep) : "");
  }
  report.table(rows);
  report.paragraph(
      "Friction has one direction in a step. In the step in which the block turns back it changes it at one "
      "of its ends. The velocity afterwards errs by up to 2 g cos a tan φ Δt, and the way by that times the "
      "time since.");
  picture(report);
  report.claims(
      {{"Sliding on: the way to 1e-6.", down_error <= 1e-6, text(down_error)},
       {"It comes to rest in time, to half a step: the last velocity before is the mean of that and of "
        "rest.",
        time_error <= 0.5, fmt::format("{:.3f} steps", time_error)},
       {"The way to where it turns, to 1e-3 at every Δt from 0.02 to 0.001 s.", turning_error <= 1e-3,
        text(turning_error)},
       {"It rests where friction is above the slope, and slides back where it is below.", rests,
        rests ? "it does" : "not always"},
       {"Where it rests: the way to 1e-3.", resting_error <= 1e-3, text(resting_error)},
       {"It does not creep: below 1e-12 m in half a second.", creep <= 1e-12, text(creep)},
       {"Back down: an error below that of friction the wrong way for one step.", back_error <= 1,
        fmt::format("{} of it at most", text(back_error))}});
}

}  // namespace validation
