#include "mechanics_chapters.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>

#include <array>
#include <cmath>

namespace verification {

namespace {

constexpr double slope = 30, end_time = 0.3;  // degrees, s

/// How a block of base b and height h starts on a slope.
struct Start {
  bool slides = false, topples = false;
  bool operator==(const Start&) const = default;
};

const char* name(const Start& start) {
  return start.slides ? start.topples ? "slides and topples" : "slides" : start.topples ? "topples" : "rests";
}

/// Of a rigid block. One that topples without sliding needs T = m (g sin a - alpha h / 2) of
/// N = m (g cos a + alpha b / 2) at its lower edge, with alpha the angular acceleration about it; one that
/// slides has N at h tan(phi) / 2 before its centre.
Start rigid_start(double friction, double slenderness) {
  const double mu = std::tan(radians(friction)), t = std::tan(radians(slenderness)), a = radians(slope);
  const double tilting = 1.5 * (std::sin(a) - t * std::cos(a)) / (1 + t * t);  // alpha h / g
  if (tilting > 0) {
    const double needed = (std::sin(a) - tilting / 2) / (std::cos(a) + t * tilting / 2);
    if (mu >= needed) return {false, true};
    return {true, t < mu};
  }
  return {mu < std::tan(a), false};
}

Start computed_start(double friction, double slenderness) {
  const double a = radians(slope), b = std::tan(radians(slenderness));
  Scene scene = rock_scene(0.01, static_cast<int>(std::lround(end_time / 0.01)));
  scene.joints[0].friction_angle = friction;
  scene.blocks = {block(turned(rectangle(-2, -1, 6, 1), -a), true), block(turned(rectangle(0, 0, b, 1), -a))};
  const BuiltScene built = run(scene);
  const Stepper& stepper = *built.stepper;
  const Block& of = stepper.blocks().block(1);
  const Vec2 toe = stepper.blocks().displacements(stepper.state()).col(of.vertices().first + 1);
  return {toe.dot(Vec2(std::cos(a), -std::sin(a))) > 1e-3, stepper.state().rotation[1] < -1e-3};
}

}  // namespace

void toppling(Report& report) {
  report.heading("6. Slide or topple");
  report.paragraph(
      "One block of height h and base b on a slope of 30 degrees, released at rest. By statics it slides "
      "when tan φ < tan a and topples when b/h < tan a. Once it moves, inertia counts. A block that tilts "
      "about its lower edge pushes less along the slope, so it need not slide though φ < a. The boundary is "
      "T = N tan φ at the start of tilting. A block that slides topples only when b/h < tan φ. The points "
      "are those of a grid of 3 degrees that are not within one degree of a boundary. The base edge's lower "
      "end has slid, or the block has turned, by more than 1e-3 (m, rad) in 0.3 s.");
  constexpr std::array kinds{Start{false, false}, Start{true, false}, Start{false, true}, Start{true, true}};
  Chart chart{.x_symbol = {"friction angle φ", "", ""},
              .y_symbol = {"atan b/h", "", ""},
              .x_unit = "°",
              .y_unit = "°",
              .series = {}};
  std::array<Series, 4> points;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    points[k].name = name(kinds[k]);
    points[k].markers = true;
  }
  int n_right = 0, n_statics = 0, n = 0;
  std::string wrong;
  for (double friction = 2; friction <= 56; friction += 3)
    for (double slenderness = 5; slenderness <= 56; slenderness += 3) {
      const Start expected = rigid_start(friction, slenderness);
      bool near_boundary = false;
      for (const double x : {-1., 0., 1.})
        for (const double y : {-1., 0., 1.})
          near_boundary = near_boundary || !(rigid_start(friction + x, slenderness + y) == expected);
      if (near_boundary) continue;
      const Start seen = computed_start(friction, slenderness);
      ++n;
      n_right += seen == expected;
      n_statics += (seen.slides || seen.topples) == (friction < slope || slenderness < slope);
      if (!(seen == expected))
        wrong += fmt::format(" φ = {}°, atan b/h = {}°: {} instead of {};", friction, slenderness, name(seen),
                             name(expected));
      for (std::size_t k = 0; k < kinds.size(); ++k)
        if (seen == kinds[k]) {
          points[k].x.push_back(friction);
          points[k].y.push_back(slenderness);
        }
    }
  const auto guide = [&](const auto& x, const auto& y) {
    chart.series.push_back({"", x, y, false, false, true});
  };
  guide(std::vector<double>{slope, slope}, std::vector<double>{slope, 58});
  guide(std::vector<double>{slope, 58}, std::vector<double>{slope, slope});
  std::vector<double> tilting_x, tilting_y, sliding_x, sliding_y;
  for (double slenderness = 2; slenderness <= slope; slenderness += 0.5) {
    double low = 0, high = slope;
    while (high - low > 1e-3)
      (rigid_start((low + high) / 2, slenderness).slides ? low : high) = (low + high) / 2;
    tilting_x.push_back(low);
    tilting_y.push_back(slenderness);
    if (slenderness < low) {
      sliding_x.push_back(slenderness);
      sliding_y.push_back(slenderness);
    }
  }
  guide(tilting_x, tilting_y);
  guide(sliding_x, sliding_y);
  for (const Series& series : points) chart.series.push_back(series);
  report.picture("mechanics_toppling",
                 draw({chart}, {.title = "One block on a slope of 30 degrees", .plot_height = 380}),
                 "What the block does (marks), and the boundaries for a rigid one (grey).");
  report.claims({{"By statics: it moves when φ < a or b/h < tan a, and only then.", n_statics == n,
                  fmt::format("{} of {} points", n_statics, n)},
                 {"Every point further than a degree from a boundary does what a rigid block does.",
                  n_right == n, fmt::format("{} of {} points{}", n_right, n, wrong)}});
}

}  // namespace verification
