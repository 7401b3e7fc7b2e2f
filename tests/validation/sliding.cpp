/// \file Blocks that slide, stiff and soft, after they settled.
#include "chapters.hpp"
#include "slider.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace validation {

namespace {

constexpr double time_steps[] = {0.02, 0.01, 0.005, 0.002, 0.001, 5e-4};
constexpr double penalties[] = {1, 40, 1000};  // of E

/// Friction angles from 0 to 5 degrees below the slope.
std::vector<double> friction_angles(double slope) {
  return {0, slope - 20, slope - 10, slope - 5};
}

/// Over friction angles and penalties.
struct Errors {
  double largest = 0;  ///< of the way, against that of the rigid block
  double spread = 0;   ///< between penalties, of the way over that of the rigid block
  double least_way = std::numeric_limits<double>::infinity(), most_way = 0;  ///< over that of the rigid block
  long rejected = 0;

  void take(const Errors& other) {
    largest = std::max(largest, other.largest);
    spread = std::max(spread, other.spread);
    least_way = std::min(least_way, other.least_way);
    most_way = std::max(most_way, other.most_way);
    rejected += other.rejected;
  }
};

Errors errors(Slider slider, double slope) {
  Errors errors;
  slider.angle = radians(slope);
  for (const double friction : friction_angles(slope)) {
    slider.friction = std::tan(radians(friction));
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const double penalty : penalties) {
      slider.penalty = penalty;
      const BuiltScene built = settled(slider_scene(slider));
      const double way = run_slider(slider, *built.stepper).way /
                         (slider.acceleration() * slider.duration * slider.duration / 2);
      errors.largest = std::max(errors.largest, std::abs(way - 1));
      least = std::min(least, way);
      most = std::max(most, way);
      errors.rejected += built.stepper->counts().rejected;
    }
    errors.spread = std::max(errors.spread, most - least);
    errors.least_way = std::min(errors.least_way, least);
    errors.most_way = std::max(errors.most_way, most);
  }
  return errors;
}

void stiff_blocks(Report& report) {
  report.paragraph("### Stiff blocks");
  report.paragraph(
      "E = 35 GPa, friction angles 0 and 20, 10 and 5 degrees below the slope, penalties E, 40 E and 1000 E. "
      "The table has the largest error of the way after one second, without damping and with "
      "stiffness-proportional damping of ratio 0.3 in the block's first mode. It also has the largest "
      "difference between penalties:");
  std::vector<std::vector<std::string>> rows{
      {"slope", "Δt, s", "undamped", "between penalties", "damped", "between penalties"}};
  Errors undamped, damped;
  for (const double slope : {45., 30.})
    for (const double time_step : time_steps) {
      const Errors without = errors({.time_step = time_step}, slope);
      const Errors with = errors({.time_step = time_step, .damping = 0.3}, slope);
      rows.push_back({degrees_text(slope), fmt::format("{:g}", time_step), text(without.largest),
                      text(without.spread), text(with.largest), text(with.spread)});
      undamped.take(without);
      damped.take(with);
    }
  report.table(rows);
  report.claims(
      {{"Error of the way at most 1e-3 without damping.", undamped.largest <= 1e-3, text(undamped.largest)},
       {"At most 1e-4 with damping.", damped.largest <= 1e-4, text(damped.largest)},
       {"No step had to be cut.", undamped.rejected + damped.rejected == 0,
        fmt::format("{} cut", undamped.rejected + damped.rejected)}});
}

void soft_blocks(Report& report) {
  report.paragraph("### Soft blocks");
  report.paragraph(
      "E = 35 MPa with damping of ratio 0.3, the same friction angles and penalties. At 30 degrees the "
      "error; at "
      "40 degrees the way over that of the rigid block, for each friction angle least and most over the "
      "penalties, "
      "and their range over all:");
  std::vector<std::vector<std::string>> rows{
      {"Δt, s", "30°: error", "between penalties", "40°: least", "most"}};
  Errors at_30, at_40;
  for (const double time_step : time_steps) {
    const Slider slider{.time_step = time_step, .young = soft, .damping = 0.3};
    const Errors gentle = errors(slider, 30), steep = errors(slider, 40);
    at_30.take(gentle);
    at_40.take(steep);
    rows.push_back({fmt::format("{:g}", time_step), text(gentle.largest), text(gentle.spread),
                    fmt::format("{:.6f}", steep.least_way), fmt::format("{:.6f}", steep.most_way)});
  }
  const double range_40 = at_40.most_way - at_40.least_way;
  report.table(rows);
  report.claims(
      {{"At 30 degrees the error of the way is at most 1e-3.", at_30.largest <= 1e-3, text(at_30.largest)},
       {"At 40 degrees the way does not depend on Δt and penalty, to 1e-2.", range_40 <= 1e-2,
        text(range_40)}});
}

/// Along the slope, N/m3, while the block has been let go.
TimeFunction load_along(const Slider& slider, double (*acceleration)(double time)) {
  constexpr double entry = 1e-4;  // s
  TimeFunction history{TimeFunction::Kind::history, Vec2::Zero(), {}};
  for (int k = 0; k * entry < slider.duration + 0.05; ++k) {
    const Vec2 force = slider_density * acceleration(k * entry) * slider.down();
    history.history.emplace_back(settling_time + k * entry, force.x(), force.y());
  }
  return history;
}

constexpr double sway = 1.5, sway_pulsation = 2 * turn;  // m/s2, rad/s

double swaying(double time) {
  return sway * std::sin(sway_pulsation * time);
}
double pushing(double time) {
  const double s = std::sin(turn * time / 0.8);
  return 3 * s * s;
}

Scene loaded_scene(const Slider& slider, double (*acceleration)(double time)) {
  Scene scene = slider_scene(slider);
  Load load;
  load.kind = Load::Kind::body;
  load.block = 1;
  load.force = load_along(slider, acceleration);
  scene.loads = {load};
  return scene;
}

/// How a scheme is named on this page, and what it takes.
struct Method {
  const char* name;
  Scheme scheme;
  bool as_paper = false;  ///< the paper preset, with its contacts
};
constexpr Method methods[] = {{"decaying (default)", Scheme::decaying},
                              {"midpoint", Scheme::midpoint},
                              {"backward Euler", Scheme::backward_euler},
                              {"paper preset", Scheme::dda, true}};

void set_method(const Method& method, Scene& scene) {
  scene.analysis.scheme = method.scheme;
  if (!method.as_paper) return;
  scene.analysis.preset = Preset::paper;
  scene.analysis.kinematics = Kinematics::incremental;
  scene.analysis.gradient_correction = GradientCorrection::off;
  scene.analysis.cutting_factor = 0.3;
  scene.contact.method = ContactMethod::classic;
  scene.contact.penetration_tolerance = 0;
}

std::string order_text(const std::vector<double>& errors, double ratio) {
  const std::size_t n = errors.size();
  return fmt::format("{:.2f}", std::log(errors[n - 2] / errors[n - 1]) / std::log(ratio));
}

void convergence(Report& report) {
  report.paragraph("### Convergence and cost");
  report.paragraph(
      "A stiff block (35 GPa) on 30 degrees with φ = 20° under a body force along the slope of 1.5 m/s2 sin "
      "4πt never stops. Its way is s = a t²/2 + A (ωt − sin ωt)/ω². The default scheme and midpoint take the "
      "mean of the force over their steps, so that none of its impulse is lost. Error of the way after one "
      "second, relative, its order between the last two steps:");
  std::vector<std::vector<std::string>> rows{{"scheme", "0.02 s", "0.01 s", "0.005 s", "0.0025 s", "order"}};
  Chart chart{.x_symbol = {"run time", "", ""},
              .y_symbol = {"error of the way", "", ""},
              .x_unit = "ms",
              .y_unit = "",
              .series = {},
              .x_logarithmic = true,
              .y_logarithmic = true};
  double largest = 0;
  for (const Method& method : methods) {
    Slider slider{.angle = radians(30), .friction = std::tan(radians(20))};
    std::vector<double> found;
    Series cost{method.name, {}, {}};
    cost.dots = true;
    for (const double time_step : {0.02, 0.01, 0.005, 0.0025}) {
      slider.time_step = time_step;
      Scene scene = loaded_scene(slider, swaying);
      set_method(method, scene);
      const double exact = slider.acceleration() / 2 + sway / (sway_pulsation * sway_pulsation) *
                                                           (sway_pulsation - std::sin(sway_pulsation));
      double way = 0;
      const BuiltScene built = settled(scene);
      const double seconds = seconds_of([&] { way = run_slider(slider, *built.stepper).way; });
      found.push_back(std::abs(way / exact - 1));
      cost.x.push_back(1e3 * seconds);
      cost.y.push_back(found.back());
    }
    rows.push_back({method.name});
    for (const double error : found) rows.back().push_back(text(error));
    rows.back().push_back(order_text(found, 2));
    chart.series.push_back(cost);
    if (method.scheme == Scheme::decaying || method.scheme == Scheme::midpoint)
      largest = std::max(largest, *std::ranges::max_element(found));
  }
  report.table(rows);
  report.picture("dda_sliding_cost",
                 draw({chart}, {.title = "A block that slides under a force that sways", .plot_height = 260}),
                 "Error of the way after one second over run time, for steps of 0.02 to 0.0025 s.");

  report.paragraph(
      "A soft block (35 MPa, ratio 0.3) clings to 30 degrees under a body force along the slope of 3 m/s2 "
      "sin² (πt/0.8 s), penetration to 1e-10 of the block. Error of how far its top has moved after 0.3 s, "
      "against midpoint steps of 5e-5 s:");
  rows = {{"scheme", "0.01 s", "0.005 s", "0.0025 s", "0.00125 s", "order"}};
  const auto lean = [](const Method& method, double time_step) {
    const Slider slider{.angle = radians(30),
                        .friction = 50,
                        .time_step = time_step,
                        .duration = 0.3,
                        .young = soft,
                        .damping = 0.3};
    Scene scene = loaded_scene(slider, pushing);
    scene.contact.penetration_tolerance = 1e-10;
    set_method(method, scene);
    const BuiltScene built = settled(scene);
    const Stepper& stepper = *built.stepper;
    const auto top = [&] {
      return stepper.blocks()
          .displacements(stepper.state())
          .col(stepper.blocks().block(1).vertices().first + 2)
          .dot(slider.down());
    };
    const double start = top();
    run(*built.stepper, static_cast<int>(std::lround(slider.duration / time_step)));
    return top() - start;
  };
  const double reference = lean(methods[1], 5e-5);
  double order_decaying = 0, order_midpoint = 0;
  for (const Method& method : {methods[0], methods[1], methods[2]}) {
    std::vector<double> found;
    rows.push_back({method.name});
    for (const double time_step : {0.01, 0.005, 0.0025, 0.00125}) {
      found.push_back(std::abs(lean(method, time_step) / reference - 1));
      rows.back().push_back(text(found.back()));
    }
    rows.back().push_back(order_text(found, 2));
    const double order = std::log2(found[2] / found[3]);
    if (method.scheme == Scheme::decaying) order_decaying = order;
    if (method.scheme == Scheme::midpoint) order_midpoint = order;
  }
  report.table(rows);
  report.claims(
      {{"By the default scheme and by midpoint the way is off by at most 1e-5 in any of these steps.",
        largest <= 1e-5, text(largest)},
       {"Deformation converges with order 2 by midpoint (1.8 at least).", order_midpoint >= 1.8,
        fmt::format("{:.2f}", order_midpoint)},
       {"Deformation converges with order 1 by the default scheme (0.9 at least).", order_decaying >= 0.9,
        fmt::format("{:.2f}", order_decaying)}});
}

}  // namespace

void sliding(Report& report) {
  report.heading("1. Sliding");
  report.paragraph(
      "A block of 3 x 1.5 m and 2600 kg/m3 comes to rest on a rigid slope in a static stage with a friction "
      "angle of "
      "89 degrees. Then it has the friction stated and slides; a rigid block does so by s = g (sin a − tan φ "
      "cos a) "
      "t²/2. The way is that of the centroid.");
  stiff_blocks(report);
  soft_blocks(report);
  vibration_by_friction(report);
  convergence(report);
}

}  // namespace validation
