/// \file Blocks that slide, stiff and soft, after they settled.
#include "chapters.hpp"
#include "slider.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <utility>

namespace validation {

namespace {

constexpr double time_steps[] = {0.02, 0.01, 0.005, 0.002, 0.001, 5e-4};
constexpr double penalties[] = {1, 40, 1000};  // of E
constexpr double soft = 35e6;                  // Pa

std::string degrees_text(double angle) {
  return fmt::format("{:g}°", angle);
}

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
      "E = 35 GPa, friction angles 0 and 20, 10 and 5 degrees below the slope, penalties E, 40 E and 1000 E: "
      "the "
      "largest error of the way after one second, without damping and with stiffness-proportional damping of "
      "ratio 0.3 in the block's first mode, and the largest difference between penalties:");
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
}

}  // namespace validation
