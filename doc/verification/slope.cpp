#include "mechanics_chapters.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace verification {

namespace {

/// Where the pull along the slope begins and is whole, from where on acceleration is measured, and until
/// when, s.
constexpr double pull_begins = 0.1, pull_whole = 0.6, measured_from = 0.7, end_time = 1.4;

/// A block of 4 x 2 m on a slope that falls to the right.
struct Slide {
  double angle, friction;  ///< radians, tan(phi)
  double time_step;
  double penalty = 40;  ///< of E
  bool settled = true;  ///< gravity pulls along the slope little by little
  double young = 35e9;
};

constexpr double slider_height = 2;  ///< m

struct Slid {
  double acceleration_by_distance = 0, acceleration_by_velocity = 0;
  double velocity = 0;  ///< at the end
  long rejected = 0;
};

double exact_acceleration(const Slide& slide) {
  return gravity * (std::sin(slide.angle) - std::cos(slide.angle) * slide.friction);
}

/// Grows from 0 to 1 with two derivatives, linear between 100 points.
TimeFunction slow_start(const Vec2& force) {
  TimeFunction history{TimeFunction::Kind::history, Vec2::Zero(), {}};
  for (int k = 0; k <= 100; ++k) {
    const double s = k / 100., grown = s * s * s * (10 - 15 * s + 6 * s * s);
    history.history.emplace_back(pull_begins + s * (pull_whole - pull_begins), grown * force.x(),
                                 grown * force.y());
  }
  return history;
}

Scene slide_scene(const Slide& slide) {
  const double a = slide.angle;
  const Vec2 along(std::cos(a), -std::sin(a)), normal(std::sin(a), std::cos(a));
  Scene scene =
      rock_scene(slide.time_step, static_cast<int>(std::lround(end_time / slide.time_step)), slide.young);
  const Material& rock = scene.materials[0];
  scene.blocks = {block(turned(rectangle(-5, -1, 60, 1), -a), true),
                  block(turned(rectangle(0, 0, 4, slider_height), -a))};
  scene.joints[0].friction_angle = std::atan(slide.friction) * 360 / turn;
  scene.contact.normal_stiffness = slide.penalty * rock.young;
  scene.contact.tangential_stiffness = scene.contact.normal_stiffness / 2.5;
  if (slide.settled) {
    scene.analysis.gravity = -gravity * std::cos(a) * normal;
    Load load;
    load.kind = Load::Kind::body;
    load.block = 1;
    load.force = slow_start(rock.density * gravity * std::sin(a) * along);
    scene.loads = {load};
  }
  return scene;
}

Slid run_slide(const Slide& slide) {
  const Vec2 along(std::cos(slide.angle), -std::sin(slide.angle));
  const Scene scene = slide_scene(slide);
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  const int first = slide.settled ? static_cast<int>(std::lround(measured_from / slide.time_step)) : 0;
  run(stepper, first);
  const double x0 = travel(stepper, 1).dot(along), v0 = velocity(stepper, 1).dot(along);
  run(stepper, scene.analysis.steps - first);
  const double time = stepper.state().time - first * slide.time_step;
  Slid slid;
  slid.velocity = velocity(stepper, 1).dot(along);
  slid.acceleration_by_distance = 2 * (travel(stepper, 1).dot(along) - x0 - v0 * time) / (time * time);
  slid.acceleration_by_velocity = (slid.velocity - v0) / time;
  slid.rejected = stepper.counts().rejected;
  return slid;
}

const std::vector<double> time_steps{0.02, 0.01, 0.005, 0.002, 0.001};
const std::vector<double> penalties{1, 10, 100, 1000};

void accuracy(Report& report, bool settled) {
  report.paragraph(settled ? "### Settled first" : "### Under sudden gravity");
  report.paragraph(
      settled ? "The weight's part across the slope acts from the start, its part along the slope grows "
                "smoothly from 0 to all of it between 0.1 and 0.6 s. The distance from 0.7 to 1.4 s, less "
                "that by the velocity at 0.7 s, is compared with half the rigid block's acceleration times "
                "the time squared. The table has the largest relative error over five friction angles, 1 to "
                "45 degrees below the slope, and its largest change from penalty to penalty:"
              : "All of gravity acts from the start, as in the paper. An elastic block is thrown into "
                "vibration of about g h/c = 5 mm/s, loses contact now and then, and friction does not act "
                "while it does. That is what an elastic block does, and (53) knows nothing of it. Large "
                "steps do not resolve it. The same errors:");
  std::vector<std::vector<std::string>> rows{{"slope", "Δt, s"}};
  for (const double p : penalties) rows[0].push_back(fmt::format("p = {:g} E", p));
  rows[0].push_back("spread over p");
  double worst = 0, worst_spread = 0;
  long rejected = 0;
  for (const double degrees : {45., 30.})
    for (const double dt : time_steps) {
      std::vector<std::string> row{fmt::format("{:g}°", degrees), fmt::format("{:g}", dt)};
      std::map<double, std::vector<double>> ratios;  // by friction angle
      double spread = 0;
      for (const double p : penalties) {
        double largest = 0;
        for (const double below : {1., 2., 5., 15., degrees}) {
          const Slide slide{radians(degrees), std::tan(radians(degrees - below)), dt, p, settled};
          const Slid slid = run_slide(slide);
          const double ratio = slid.acceleration_by_distance / exact_acceleration(slide);
          largest = std::max(largest, std::abs(ratio - 1));
          ratios[below].push_back(ratio);
          rejected += slid.rejected;
        }
        row.push_back(text(largest));
        worst = std::max(worst, largest);
      }
      for (const auto& [below, of] : ratios)
        spread = std::max(spread,
                          *std::max_element(of.begin(), of.end()) - *std::min_element(of.begin(), of.end()));
      worst_spread = std::max(worst_spread, spread);
      row.push_back(text(spread));
      rows.push_back(row);
    }
  report.table(rows);
  if (settled)
    report.claims(
        {{"Friction 1 to 45 degrees below the slope, Δt 0.02 to 0.001: error at most 1e-3.", worst <= 1e-3,
          text(worst)},
         {"The same to 1e-4 for penalties from E to 1000 E.", worst_spread <= 1e-4, text(worst_spread)},
         {"No step had to be cut.", rejected == 0, fmt::format("{} rejected", rejected)}});
}

double error_of_distance(double young, double dt, double part_of_limit) {
  const Slide slide{.angle = radians(45),
                    .friction = part_of_limit,
                    .time_step = end_time / std::round(end_time / dt),
                    .young = young};
  return std::abs(run_slide(slide).acceleration_by_distance / exact_acceleration(slide) - 1);
}

/// The error of the distance by friction, a row for each way of a wave in a step.
struct ErrorsByFriction {
  static constexpr std::array<double, 6> parts_of_limit{0, 0.25, 0.5, 0.75, 0.9, 0.98};
  std::vector<std::vector<std::string>> rows{{"c Δt / L", "E, MPa", "Δt, ms"}};
  Chart chart{.x_symbol = {"c Δt / L", "", ""},
              .y_symbol = {"error", "", ""},
              .x_unit = "",
              .y_unit = "",
              .series = {},
              .x_logarithmic = true,
              .y_logarithmic = true};

  ErrorsByFriction() {
    for (const double part : parts_of_limit) {
      rows[0].push_back(fmt::format("μ = {:g} tan a", part));
      chart.series.push_back({rows[0].back(), {}, {}});
      chart.series.back().dots = true;
    }
  }

  /// The largest error with this modulus and step; `ratio`: c Δt / L.
  double add(double ratio, double young, double dt, bool in_chart) {
    std::vector<std::string> row{fmt::format("{:.2g}", ratio), fmt::format("{:.3g}", young / 1e6),
                                 fmt::format("{:.3g}", 1e3 * dt)};
    double largest = 0;
    for (std::size_t k = 0; k < parts_of_limit.size(); ++k) {
      const double error = error_of_distance(young, dt, parts_of_limit[k]);
      row.push_back(text(error));
      largest = std::max(largest, error);
      if (!in_chart) continue;
      chart.series[k].x.push_back(ratio);
      chart.series[k].y.push_back(error);
    }
    rows.push_back(row);
    return largest;
  }
};

/// Blocks as soft as that a pressure wave crosses them in any number of steps.
void softness(Report& report) {
  constexpr double softest = 35e6, longest_step = 0.02, poisson = 0.3, density = 2500;
  const auto wave = [&](double young) {
    return std::sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / density);
  };
  report.paragraph("### Softer blocks");
  report.paragraph(
      "The same on 45 degrees, settled first, over the way c Δt of a pressure wave in a step in heights "
      "L = 2 m of the block: E = 35 MPa with steps of that length up to 20 ms, from there on stiffer blocks "
      "with steps of 20 ms; then E = 35 GPa with shorter steps. In steps that resolve its waves a soft "
      "block vibrates by friction, leaves the slope for moments, and slides faster than a rigid one: the "
      "smaller what is left of the pull, the more. The error of the distance:");
  ErrorsByFriction errors;
  double worst_slow = 0, worst_rock = 0;
  for (const double ratio : {0.03, 0.1, 0.3, 1., 3., 10., 30., 100.}) {
    const double dt = std::min(longest_step, ratio * slider_height / wave(softest)),
                 young = softest * std::pow(ratio * slider_height / dt / wave(softest), 2),
                 error = errors.add(ratio, young, dt, true);
    if (ratio >= 3) worst_slow = std::max(worst_slow, error);
  }
  for (const double dt : {0.02, 0.005, 0.001, 2e-4})
    worst_rock = std::max(worst_rock, errors.add(wave(35e9) * dt / slider_height, 35e9, dt, false));
  report.table(errors.rows);
  report.picture("mechanics_sliding_softness",
                 draw({errors.chart}, {.title = "Error of the distance of a sliding block"}),
                 "The error over the way of a wave in a step, by friction.");
  report.claims(
      {{"At most 1e-6 where a wave crosses the block three times in a step.", worst_slow <= 1e-6,
        text(worst_slow)},
       {"At most 1e-8 with 35 GPa in steps of 20 to 0.2 ms.", worst_rock <= 1e-8, text(worst_rock)}});
}

void limit(Report& report) {
  report.paragraph("### At the limit");
  report.paragraph(
      "Friction μ = tan a (1 ± 1e-6): with the upper sign the block must stay, with the lower one it must "
      "slide with "
      "1e-6 g sin a. Velocity at 1.4 s and acceleration since 0.7 s, after the same slow start:");
  std::vector<std::vector<std::string>> rows{
      {"slope", "Δt, s", "μ / tan a − 1", "velocity, m/s", "acceleration, m/s2", "exact"}};
  bool stays = true;
  double worst = 0;
  for (const double degrees : {45., 30.})
    for (const double dt : {0.02, 0.005, 0.001})
      for (const double excess : {1e-6, -1e-6}) {
        const double a = radians(degrees);
        const Slide slide{a, std::tan(a) * (1 + excess), dt};
        const Slid slid = run_slide(slide);
        const double exact = excess < 0 ? exact_acceleration(slide) : 0;
        if (excess < 0)
          worst = std::max(worst, std::abs(slid.acceleration_by_velocity / exact - 1));
        else
          stays = stays && std::abs(slid.velocity) < 1e-9;
        rows.push_back({fmt::format("{:g}°", degrees), fmt::format("{:g}", dt), text(excess),
                        text(slid.velocity), text(slid.acceleration_by_velocity), text(exact)});
      }
  report.table(rows);
  report.claims(
      {{"At μ = tan a (1 + 1e-6) the block stays (below 1e-9 m/s).", stays, stays ? "it does" : "it creeps"},
       {"At μ = tan a (1 − 1e-6) it slides with the right acceleration, to 1 %.", worst <= 0.01,
        text(worst)}});
}

}  // namespace

void sliding_over_steps(Report& report) {
  report.heading("3. Sliding, over steps and penalties");
  report.paragraph(
      "A block of 4 x 2 m on a slope, E = 35 GPa, against a rigid block: acceleration g (sin a − cos a tan "
      "φ).");
  accuracy(report, true);
  accuracy(report, false);
  softness(report);
  limit(report);
}

}  // namespace verification
