#include "mechanics_chapters.hpp"
#include "tumbling_scene.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/chart.hpp>
#include <ddacontact/picture/picture.hpp>

#include <cmath>

namespace verification {

Scene tumbling_scene(Scheme scheme, double time_step) {
  constexpr double slope = 35, side = 0.5;
  Scene scene = rock_scene(time_step, static_cast<int>(std::lround(tumbling_time / time_step)));
  scene.analysis.scheme = scheme;
  scene.joints[0].friction_angle = 60;
  scene.joints[0].restitution = 0;
  Points hexagon(2, 6);
  for (int k = 0; k < 6; ++k)
    hexagon.col(k) =
        side * Vec2(std::cos(turn * (k - 2) / 6), std::sin(turn * (k - 2) / 6) + std::sqrt(3) / 2);
  scene.blocks = {block(turned(rectangle(-2, -1, 12, 1), -radians(slope)), true),
                  block(turned(hexagon, -radians(slope)))};
  return scene;
}

const Vec2& converged_tumble() {
  static const Vec2 travelled = travel(*run(tumbling_scene(Scheme::decaying, 5e-5)).stepper, 1);
  return travelled;
}

namespace {

const std::vector<double> time_steps{0.02, 0.01, 0.005, 0.002, 0.001, 0.0005};

void flight(Report& report) {
  report.paragraph("### In flight");
  report.paragraph(
      "A pentagon is thrown at (4, 6) m/s with 5 rad/s under gravity and touches nothing. After one second "
      "its centroid is at v t + g t²/2 and it has turned by 5 rad, less 5e-6 for the stretch. Distance from "
      "there (m), and error of the angle (rad):");
  std::vector<std::vector<std::string>> rows{{"Δt, s"}};
  for (const NamedScheme& scheme : schemes) rows[0].push_back(scheme.name);
  double position = 0, order = 0, turned = 0;
  for (const double dt : {0.02, 0.01, 0.005, 0.002}) {
    std::vector<std::string> row{fmt::format("{:g}", dt)};
    for (const NamedScheme& scheme : schemes) {
      Scene scene = rock_scene(dt, static_cast<int>(std::lround(1 / dt)));
      scene.analysis.scheme = scheme.scheme;
      scene.blocks = {block(pentagon())};
      scene.blocks[0].velocity = {4, 6};
      scene.blocks[0].angular_velocity = 5;
      const BuiltScene built = run(scene);
      const double off = (travel(*built.stepper, 0) - Vec2(4, 6 - gravity / 2)).norm();
      const double angle = std::abs(built.stepper->state().rotation[0] - 5);
      row.push_back(fmt::format("{}, {}", text(off), text(angle)));
      if (scheme.scheme == Scheme::decaying || scheme.scheme == Scheme::midpoint) {
        position = std::max(position, off);
        if (scheme.scheme == Scheme::midpoint)
          order = std::max(order, (angle - 5e-6) / (5 * 5 * 5 * dt * dt / 12));
        else
          turned = std::max(turned, angle);
      }
    }
    rows.push_back(row);
  }
  report.table(rows);
  report.claims({{"Decaying and midpoint: the flight is exact.", position <= 1e-7,
                  fmt::format("{} m: the centroid of the stretched shape is not quite the centre of mass",
                              text(position))},
                 {"The decaying scheme turns by ωt, to 1e-5.", turned <= 1e-5, text(turned)},
                 {"Midpoint's angle is off by ω³Δt²t/12, as tan(θ/2) = ωΔt/2 has it.", order <= 1.05,
                  fmt::format("{:.3f} times that at most", order)}});
}

void down_a_slope(Report& report) {
  report.paragraph("### Down a slope");
  report.paragraph(
      "A hexagon of side 0.5 m rolls down a slope of 35 degrees, edge after edge, without bouncing or "
      "sliding (φ = 60 degrees), for "
      "1.6 s. Distance of its centroid (m) from where the decaying scheme has it at Δt = 5e-5 s:");
  const BuiltScene reference = build(tumbling_scene(Scheme::decaying, 0.002));
  std::vector<Frame> frames{capture_frame(*reference.stepper, reference.labels, {})};
  for (int k = 0; k < 4; ++k) {
    run(*reference.stepper, 200);
    frames.push_back(capture_frame(*reference.stepper, reference.labels, {}));
  }
  std::vector<Panel> panels;
  for (const Frame& frame : frames)
    panels.push_back({.frame = &frame, .caption = fmt::format("{:.1f} s", frame.time)});
  report.picture("mechanics_tumbling",
                 draw(panels, {.title = "A hexagon rolling down", .width = 900, .columns = 5}),
                 "The hexagon every 0.4 s, Δt = 2 ms.");

  Chart chart{.x_symbol = {"run time", "", ""},
              .y_symbol = {"distance from the converged place", "", ""},
              .x_unit = "ms",
              .y_unit = "m",
              .series = {},
              .x_logarithmic = true,
              .y_logarithmic = true};
  std::vector<std::vector<std::string>> rows{{"Δt, s"}};
  for (const double dt : time_steps) rows.push_back({fmt::format("{:g}", dt)});
  double best = 1e300;
  for (const NamedScheme& scheme : schemes) {
    rows[0].push_back(scheme.name);
    Series series{scheme.name, {}, {}};
    series.dots = true;
    for (std::size_t k = 0; k < time_steps.size(); ++k) {
      try {
        Vec2 travelled;
        const double seconds = seconds_of(
            [&] { travelled = travel(*run(tumbling_scene(scheme.scheme, time_steps[k])).stepper, 1); });
        const double off = (travelled - converged_tumble()).norm();
        if (scheme.scheme == Scheme::decaying) best = std::min(best, off);
        series.x.push_back(1e3 * seconds);
        series.y.push_back(off);
        rows[k + 1].push_back(text(off));
      } catch (const Error&) {
        rows[k + 1].push_back("stopped");
      }
    }
    chart.series.push_back(series);
  }
  report.table(rows);
  report.picture("mechanics_tumbling_cost",
                 draw({chart}, {.title = "Rolling down a slope", .plot_height = 260}),
                 "Distance from the converged place (m) against run time, by scheme.");
  report.claims({{"The decaying scheme comes to its converged place as Δt falls, to 1 cm.", best <= 0.01,
                  fmt::format("{} m at best, after {:.1f} m", text(best), converged_tumble().norm())}});
}

}  // namespace

void tumbling(Report& report) {
  report.heading("2. Tumbling");
  flight(report);
  down_a_slope(report);
}

}  // namespace verification
