/// \file A pressure wave along a bar of blocks.
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>
#include <mechanics_scenes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace validation {

namespace {

using namespace verification;

constexpr double length = 20, height = 0.5, pressure = 20e6;                             // m, m, Pa
constexpr double density = 2500, young = 35e9, poisson = 0.25;                           // kg/m3, Pa
constexpr double modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));  // lambda + 2 mu
const double wave_speed = std::sqrt(modulus / density), impedance = density * wave_speed;
const double passage = length / wave_speed;  // s
const std::vector<double> stations{length / 4, length / 2, 3 * length / 4};

/// What the bar is made of: blocks bonded to each other, blocks pressed together by twice the pressure of the
/// wave, or one block with a mesh.
enum class Bar { bonded, pressed, mesh };

struct Setting {
  Bar bar = Bar::bonded;
  int parts = 80;        ///< blocks or cells along the bar
  double courant = 0.7;  ///< c dt / size of a part
  Scheme scheme = Scheme::midpoint;
  bool fixed_end = true;
  ContactMethod method = ContactMethod::staged;

  double size() const { return length / parts; }
  double time_step() const { return courant * size() / wave_speed; }
};

Monitor probe_at(double x, const Setting& setting) {
  Monitor monitor;
  monitor.name = fmt::format("{}", x);
  monitor.kind = Monitor::Kind::point;
  monitor.block =
      setting.bar == Bar::mesh ? 0 : std::min(static_cast<int>(x / setting.size()), setting.parts - 1);
  monitor.at = {x, height / 2};
  return monitor;
}

/// Pushed at its left end from the start, held sideways; its right end is fixed or free.
Scene bar_scene(const Setting& setting) {
  Scene scene = rock_scene(setting.time_step(), 1, young);
  scene.materials = {{"rock", density, young, poisson}};
  scene.analysis.gravity.setZero();
  scene.analysis.scheme = setting.scheme;
  if (setting.method == ContactMethod::classic) {
    scene.contact.method = ContactMethod::classic;
    scene.contact.penetration_tolerance = 0;
  }
  if (setting.bar == Bar::bonded) scene.joints[0] = {"bond", 45, 1e12, 1e12, std::nullopt};
  const double before = setting.bar == Bar::pressed ? 2 * pressure : 0;
  const int n = setting.bar == Bar::mesh ? 1 : setting.parts;
  for (int b = 0; b < n; ++b) {
    BlockDescription part = block(rectangle(b * length / n, 0, length / n, height));
    part.stress = -before * Vec3(1, poisson / (1 - poisson), 0);
    if (setting.bar == Bar::mesh) {
      part.model = BlockModel::mesh;
      part.mesh.cell_size = setting.size();
    }
    scene.blocks.push_back(part);
    Support roller;
    roller.block = b;
    roller.vertices = {0, 1, 2, 3};
    roller.fix_x = false;
    scene.supports.push_back(roller);
  }
  if (setting.fixed_end) {
    Support end;
    end.block = n - 1;
    end.vertices = {1, 2};
    end.fix_y = false;
    scene.supports.push_back(end);
  }
  const auto push = [&](int part, int edge, double with) {
    Load load;
    load.kind = Load::Kind::pressure;
    load.block = part;
    load.edge = edge;
    load.force.value.x() = with;
    scene.loads.push_back(load);
  };
  push(0, 3, before + pressure);
  if (!setting.fixed_end && before > 0) push(n - 1, 1, before);
  for (const double x : stations) scene.monitors.push_back(probe_at(x, setting));
  scene.monitors.push_back(probe_at(length, setting));
  return scene;
}

/// What passes along the bar. Velocities over p/rho c, stresses over p; means of times between fronts.
struct Passed {
  std::vector<double> arrival = std::vector<double>(3, std::numeric_limits<double>::quiet_NaN());  ///< s
  double velocity = 0;      ///< half way, behind the front
  double stress = 0;        ///< there, by contacts; without any: not a number
  double end_velocity = 0;  ///< at the right end, after the front has come back from it
  double end_stress = 0;    ///< where that is fixed
  Series profile;           ///< velocity over place when the front is at 3/4 of the bar
  double seconds = 0;

  double arrival_error() const {
    double worst = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double error = std::abs(arrival[k] * wave_speed / stations[k] - 1);
      worst = error <= worst ? worst : error;  // keeps what is not a number
    }
    return worst;
  }
};

/// A mean over part of a time.
struct Mean {
  double from, to, sum = 0;
  int n = 0;
  void take(double time, double value) {
    if (time < from || time > to) return;
    sum += value;
    ++n;
  }
  double value() const { return sum / n; }
};

Passed pass(const Setting& setting) {
  Passed passed;
  const double unit = pressure / impedance, dt = setting.time_step();
  passed.seconds = seconds_of([&] {
    const BuiltScene built = build(bar_scene(setting));
    Stepper& stepper = *built.stepper;
    Mean velocity{0.7 * passage, 1.3 * passage}, stress = velocity;
    Mean end_velocity{1.2 * passage, 1.8 * passage}, end_stress = end_velocity;
    std::vector<double> before(3, 0);
    const int middle = setting.parts / 2;
    while (stepper.state().time < 1.85 * passage) {
      run(stepper, 1);
      const double t = stepper.state().time;
      for (std::size_t k = 0; k < 3; ++k) {
        const double v = observe(built.monitor_targets[k], stepper).velocity.x() / unit;
        if (v >= 0.5 && !std::isfinite(passed.arrival[k]))
          passed.arrival[k] = t - dt * (v - 0.5) / (v - before[k]);
        before[k] = v;
      }
      velocity.take(t, before[1]);
      end_velocity.take(t, observe(built.monitor_targets[3], stepper).velocity.x() / unit);
      if (setting.bar != Bar::mesh) {
        const double force = normal_force_between(stepper, middle - 1, middle) / height;
        stress.take(t, (force - (setting.bar == Bar::pressed ? 2 * pressure : 0)) / pressure);
        if (passed.profile.x.empty() && t >= 0.75 * passage)
          for (int b = 0; b < setting.parts; ++b) {
            passed.profile.x.push_back((b + 0.5) * setting.size());
            passed.profile.y.push_back(verification::velocity(stepper, b).x() / unit);
          }
      }
      if (setting.fixed_end) {
        const double force = -stepper.reactions().row(0).sum() / height;
        end_stress.take(t, (force - (setting.bar == Bar::pressed ? 2 * pressure : 0)) / pressure);
      }
    }
    passed.velocity = velocity.value();
    passed.stress = stress.n > 0 ? stress.value() : std::numeric_limits<double>::quiet_NaN();
    passed.end_velocity = end_velocity.value();
    passed.end_stress = setting.fixed_end ? end_stress.value() : 0;
  });
  return passed;
}

std::string percent(double part) {
  return std::isfinite(part) ? fmt::format("{:+.2f} %", 100 * part) : "—";
}

/// A setting as the tables call it.
struct Named {
  std::string name;
  Setting setting;
};

void plateaus(Report& report) {
  report.paragraph("### Arrival, plateau, ends");
  report.paragraph(
      "80 blocks or cells along the bar, cΔt = 0.7 of one. Arrival (half the plateau) at 1/4, 1/2 and 3/4 of "
      "the bar over x/c, less 1. Velocity over p/ρc and stress over p in the middle, behind the front, less "
      "1. Stress at a fixed end over 2p; velocity of a free end over 2p/ρc, less 1 each. Means of times "
      "between fronts. Pressed blocks: without bonds and friction, under 2p from the start.");
  const std::vector<Named> bars{
      {"bonded blocks, midpoint", {}},
      {"bonded blocks, dda", {.scheme = Scheme::dda}},
      {"bonded blocks, backward_euler", {.scheme = Scheme::backward_euler}},
      {"bonded blocks, decaying", {.scheme = Scheme::decaying}},
      {"pressed blocks, midpoint", {.bar = Bar::pressed}},
      {"pressed blocks, decaying", {.bar = Bar::pressed, .scheme = Scheme::decaying}},
      {"one mesh, midpoint", {.bar = Bar::mesh}},
      {"one mesh, decaying", {.bar = Bar::mesh, .scheme = Scheme::decaying}}};
  std::vector<std::vector<std::string>> rows{
      {"bar", "arrival 1/4", "1/2", "3/4", "velocity", "stress", "fixed end", "free end"}};
  std::vector<double> arrivals, levels;
  for (const auto& [called, setting] : bars) {
    Setting free_end = setting;
    free_end.fixed_end = false;
    const Passed fixed = pass(setting), free = pass(free_end);
    rows.push_back({called});
    for (std::size_t k = 0; k < 3; ++k)
      rows.back().push_back(percent(fixed.arrival[k] * wave_speed / stations[k] - 1));
    double level = 0;
    for (const double off :
         {fixed.velocity - 1, fixed.stress - 1, fixed.end_stress / 2 - 1, free.end_velocity / 2 - 1}) {
      rows.back().push_back(percent(off));
      if (std::isfinite(off)) level = std::max(level, std::abs(off));
    }
    arrivals.push_back(fixed.arrival_error());
    levels.push_back(level);
  }
  report.table(rows);
  const auto all_within = [](const std::vector<double>& values, std::size_t from, std::size_t to,
                             double bar) {
    return std::all_of(values.begin() + static_cast<long>(from), values.begin() + static_cast<long>(to),
                       [bar](double value) { return value <= bar; });
  };
  const auto figure = [](double value) { return fmt::format("{:.2f} % at most", 100 * value); };
  report.claims(
      {{"Blocks and mesh, every scheme: arrival within 2 %.", all_within(arrivals, 0, bars.size(), 0.02),
        figure(*std::max_element(arrivals.begin(), arrivals.end()))},
       {"Velocity p/ρc, stress p, doubled stress and velocity at the ends, to 1 %.",
        all_within(levels, 0, bars.size(), 0.01), figure(*std::max_element(levels.begin(), levels.end()))}});
}

void fronts(Report& report) {
  Chart chart{
      .x_symbol = {"x", "", ""}, .y_symbol = {"v ρc/p", "", ""}, .x_unit = "m", .y_unit = "", .series = {}};
  const double front = 0.75 * length;
  chart.series.push_back({"exact", {0, front, front, length}, {1, 1, 0, 0}});
  for (const auto& [called, setting] :
       {Named{"midpoint, cΔt = 0.7 h", {}}, Named{"midpoint, cΔt = 0.2 h", {.courant = 0.2}},
        Named{"dda", {.scheme = Scheme::dda}}, Named{"backward_euler", {.scheme = Scheme::backward_euler}},
        Named{"decaying", {.scheme = Scheme::decaying}}}) {
    Series profile = pass(setting).profile;
    profile.name = called;
    chart.series.push_back(profile);
  }
  report.picture("dda_wave_profiles",
                 draw({chart}, {.title = "Velocity when the front is at 15 m, 80 bonded blocks",
                                .width = 760,
                                .plot_height = 300}),
                 "Velocity of the blocks along the bar when the front is at three quarters of it.");
}

/// Of a joint's springs in series with the blocks.
double springs_slow_down(const Setting& setting) {
  const double joint = 2 * 40 * young / height;  // Pa/m, of two contacts
  return std::sqrt(1 + modulus / (joint * setting.size())) - 1;
}

void refinement(Report& report) {
  report.paragraph("### Error against blocks, steps and run time");
  report.paragraph(
      "Largest error of the three arrivals, by blocks along the bar and scheme (bonded blocks). Blocks in a "
      "row are linear elements with their consistent mass. With steps by the midpoint a wave of number k "
      "runs at c (1 + k²h²/24 − k²c²Δt²/12). So short waves run ahead of the front, or behind it, and those "
      "of cΔt = 0.71 h hardly do. A front spreads as (h² x)^(1/3). Damping schemes smear it as (cΔt x)^(1/2) "
      "instead, to both sides alike. `classic` has its springs in series with the blocks. At p = 40 E they "
      "slow the wave to 1/√(1 + M/kh), where M = λ + 2μ and k is the stiffness of a joint.");
  const std::vector<Named> ways{{"midpoint", {}},
                                {"dda", {.scheme = Scheme::dda}},
                                {"backward_euler", {.scheme = Scheme::backward_euler}},
                                {"decaying", {.scheme = Scheme::decaying}},
                                {"mesh, decaying", {.bar = Bar::mesh, .scheme = Scheme::decaying}},
                                {"classic, dda", {.scheme = Scheme::dda, .method = ContactMethod::classic}}};
  const std::vector<int> parts{20, 40, 80, 160};
  std::vector<std::vector<std::string>> rows{{"blocks"}};
  for (const int n : parts) rows.push_back({fmt::format("{}", n)});
  Chart chart{.x_symbol = {"run time", "", ""},
              .y_symbol = {"error of the arrival", "", ""},
              .x_unit = "ms",
              .y_unit = "",
              .series = {},
              .x_logarithmic = true,
              .y_logarithmic = true};
  double finest = 0, springs = 0;
  for (const auto& [called, setting] : ways) {
    rows[0].push_back(called);
    Series series{called, {}, {}};
    series.dots = true;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (setting.bar == Bar::mesh && parts[k] > 80) {
        rows[k + 1].push_back("");
        continue;
      }
      Setting refined = setting;
      refined.parts = parts[k];
      const Passed passed = pass(refined);
      const double error = passed.arrival_error();
      rows[k + 1].push_back(text(error));
      series.x.push_back(1e3 * passed.seconds);
      series.y.push_back(error);
      if (parts[k] == 160 && setting.method == ContactMethod::staged && setting.bar == Bar::bonded)
        finest = std::max(finest, error);
      if (setting.method == ContactMethod::classic && parts[k] == 160)
        springs = std::abs(error - springs_slow_down(refined));
    }
    chart.series.push_back(series);
  }
  rows[0].push_back("its springs' part");
  for (std::size_t k = 0; k < parts.size(); ++k)
    rows[k + 1].push_back(text(springs_slow_down({.parts = parts[k]})));
  report.table(rows);
  report.picture("dda_wave_cost",
                 draw({chart}, {.title = "Arrival of a wave along a bar", .plot_height = 280}),
                 "Error of the arrival against run time: 20, 40, 80 and 160 blocks.");
  report.claims({{"160 bonded blocks: arrival within 2 % by every scheme.", finest <= 0.02, text(finest)},
                 {"With 160 blocks `classic` is late by what its springs make, to 0.5 %.", springs <= 0.005,
                  text(springs) + " off"}});
}

}  // namespace

void wave(Report& report) {
  report.heading("A pressure wave along a bar");
  report.paragraph(
      fmt::format("A bar of {:g} x {:g} m, held sideways, has E = 35 GPa, ν = 0.25 and 2500 kg/m3. It is "
                  "pushed at its left end by p = 20 MPa from t = 0. Behind a front that runs at c = √((λ + "
                  "2μ)/ρ) = {:.0f} m/s it moves at p/ρc under the stress p. A fixed end doubles the stress, "
                  "a free one the velocity.",
                  length, height, wave_speed));
  plateaus(report);
  fronts(report);
  refinement(report);
}

}  // namespace validation
