/// \file Whether one block on a slope slides or topples.
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>
#include <mechanics_scenes.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace validation {

namespace {

using namespace verification;

constexpr double aside = 0.02;                       // of a boundary
constexpr double time_step = 0.01, most_time = 0.6;  // s
constexpr double turned_enough = 0.01;               // rad: by then it shows how the block started
constexpr double topples_from = 1e-3;                // rad
constexpr double slides_from = 2e-5;                 // of the height

/// A slope and the height of the blocks that are put on it.
struct Slope {
  double angle, height;  ///< degrees, m
  double steepness() const { return std::tan(radians(angle)); }
};
constexpr std::array slopes{Slope{20, 1}, Slope{35, 4}, Slope{50, 0.5}};

/// On a slope of a: mu = tan(phi) and t = b/h over tan(a).
struct Place {
  double friction = 0, slenderness = 0;
};

struct Start {
  bool slides = false, topples = false;
  bool operator==(const Start&) const = default;
};

constexpr std::array kinds{Start{false, false}, Start{true, false}, Start{false, true}, Start{true, true}};

const char* name(const Start& start) {
  return start.slides ? start.topples ? "slides and topples" : "slides" : start.topples ? "topples" : "rests";
}

/// T/N at the lower edge of a block that begins to tilt about it without sliding, over tan(a).
double friction_to_tilt(const Slope& slope, double slenderness) {
  const double a = radians(slope.angle), t = slenderness * slope.steepness();
  const double tilting =
      1.5 * (std::sin(a) - t * std::cos(a)) / (1 + t * t);  // angular acceleration times h/g
  return (std::sin(a) - tilting / 2) / (std::cos(a) + t * tilting / 2) / slope.steepness();
}

/// Of a rigid block.
Start rigid_start(const Slope& slope, const Place& point) {
  if (point.slenderness >= 1) return {point.friction < 1, false};
  const bool slides = point.friction < friction_to_tilt(slope, point.slenderness);
  return {slides, !slides || point.slenderness < point.friction};
}

Start computed_start(const Slope& slope, const Place& point) {
  const double a = radians(slope.angle), h = slope.height, b = point.slenderness * slope.steepness() * h;
  Scene scene = rock_scene(time_step, 1);
  scene.joints[0].friction_angle = std::atan(point.friction * slope.steepness()) * 360 / turn;
  scene.blocks = {block(turned(rectangle(-2 * h - b, -h, 12 * h + 2 * b, h), -a), true),
                  block(turned(rectangle(0, 0, b, h), -a))};
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  while (stepper.state().time < most_time && std::abs(stepper.state().rotation[1]) < turned_enough)
    run(stepper, 1);
  const Vec2 toe =
      stepper.blocks().displacements(stepper.state()).col(stepper.blocks().block(1).vertices().first + 1);
  return {toe.dot(Vec2(std::cos(a), -std::sin(a))) > slides_from * h,
          -stepper.state().rotation[1] > topples_from};
}

/// Places on both sides of a boundary.
struct Boundary {
  const char* between;
  std::vector<Place> points;
};

std::vector<Boundary> boundaries(const Slope& slope) {
  std::vector<Boundary> found{{"rests or slides", {}},
                              {"rests or topples", {}},
                              {"topples, without or with sliding", {}},
                              {"slides, without or with toppling", {}}};
  for (const double side : {1 - aside, 1 + aside}) {
    for (const double slenderness : {1.05, 1.2, 1.4, 1.6}) found[0].points.push_back({side, slenderness});
    for (const double friction : {1.05, 1.2, 1.4, 1.6}) found[1].points.push_back({friction, side});
    for (const double slenderness : {0.2, 0.4, 0.6, 0.8, 0.9})
      found[2].points.push_back({side * friction_to_tilt(slope, slenderness), slenderness});
    for (const double friction : {0.2, 0.4, 0.6, 0.8}) found[3].points.push_back({friction, side * friction});
  }
  return found;
}

/// All over the chart, but for places within `aside` of a boundary.
std::vector<Place> grid(const Slope& slope) {
  std::vector<Place> points;
  for (double friction = 0.05; friction < 1.7; friction += 0.15)
    for (double slenderness = 0.1; slenderness < 1.7; slenderness += 0.15) {
      const Start start = rigid_start(slope, {friction, slenderness});
      bool near_boundary = false;
      for (const double side : {1 - aside, 1 + aside})
        near_boundary = near_boundary || rigid_start(slope, {side * friction, slenderness}) != start ||
                        rigid_start(slope, {friction, side * slenderness}) != start;
      if (!near_boundary) points.push_back({friction, slenderness});
    }
  return points;
}

/// The map of a slope with its boundaries, and what blocks were seen to do.
class Map {
 public:
  explicit Map(const Slope& slope)
      : chart_{.x_symbol = {"tan φ / tan a", "", ""},
               .y_symbol = {fmt::format("(b/h) / tan a, a = {:g}°", slope.angle), "", ""},
               .x_unit = "",
               .y_unit = "",
               .series = {}} {
    // one line that passes the point where all meet several times
    Series line{.name = "boundaries", .x = {1, 1, 1.7, 1, 0}, .y = {1.7, 1, 1, 1, 0}, .guide = true};
    for (double slenderness = 1; slenderness > 0; slenderness -= 0.01) {
      line.x.push_back(friction_to_tilt(slope, slenderness));
      line.y.push_back(slenderness);
    }
    chart_.series = {line};
    for (const Start& kind : kinds)
      chart_.series.push_back({.name = name(kind), .x = {}, .y = {}, .markers = true});
  }

  void mark(const Place& point, const Start& seen) {
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (seen == kinds[k]) {
        Series& series = chart_.series[chart_.series.size() - kinds.size() + k];
        series.x.push_back(point.friction);
        series.y.push_back(point.slenderness);
      }
  }
  const Chart& chart() const { return chart_; }

 private:
  Chart chart_;
};

struct Tally {
  int n = 0, n_right = 0;
  std::string wrong;

  void add(const Slope& slope, const Place& point, const Start& seen) {
    const Start expected = rigid_start(slope, point);
    ++n;
    n_right += seen == expected;
    if (seen != expected)
      wrong += fmt::format(" {:g}°, {:.3g}, {:.3g}: {} instead of {};", slope.angle, point.friction,
                           point.slenderness, name(seen), name(expected));
  }
  std::string text() const { return fmt::format("{} of {}{}", n_right, n, wrong); }
};

}  // namespace

void chart(Report& report) {
  report.heading("Slide or topple");
  report.paragraph(
      "A block of base b and height h on a slope of a, released at rest. By statics it slides when tan φ < "
      "tan a and topples when b/h < tan a. Where both hold, inertia decides (Sagaseta 1986; Newton's laws "
      "for a rigid block that starts). A block that tilts about its lower edge without sliding has the "
      "angular acceleration α = 3 g (sin a − (b/h) cos a)/(2 h (1 + (b/h)²)). There it needs T/N = (g sin a "
      "− α h/2)/(g cos a + α b/2) ≤ tan φ. A block that slides tilts when b/h < tan φ.");
  report.paragraph(
      fmt::format("Blocks of h = 1, 4 and 0.5 m on slopes of 20, 35 and 50 degrees, E = 35 GPa, Δt = {:g} s, "
                  "get gravity at once. A run ends when they have turned by 0.01 or after {:g} s. One slides "
                  "when its lower edge has moved by 2e-5 h along the slope, and topples when it has turned "
                  "by 1e-3. Places are 2 % to either side of every boundary, in tan φ or in b/h, and on a "
                  "grid:",
                  time_step, most_time));
  std::vector<Chart> charts;
  std::vector<Tally> tallies(5);  // of the boundaries, and of the grid
  std::vector<std::vector<std::string>> rows{{"places beside the boundary", "as the chart says"}};
  for (const Slope& slope : slopes) {
    Map map(slope);
    const auto look = [&](const std::vector<Place>& points, Tally& tally) {
      for (const Place& point : points) {
        const Start seen = computed_start(slope, point);
        tally.add(slope, point, seen);
        map.mark(point, seen);
      }
    };
    const std::vector<Boundary> beside = boundaries(slope);
    for (std::size_t k = 0; k < beside.size(); ++k) look(beside[k].points, tallies[k]);
    look(grid(slope), tallies.back());
    charts.push_back(map.chart());
  }
  bool statics = true, inertia = true;
  for (std::size_t k = 0; k + 1 < tallies.size(); ++k) {
    rows.push_back({boundaries(slopes[0])[k].between, tallies[k].text()});
    (k < 2 ? statics : inertia) = (k < 2 ? statics : inertia) && tallies[k].n_right == tallies[k].n;
  }
  report.table(rows);
  report.picture("dda_chart", draw(charts, {.title = "One block on a slope", .plot_height = 300}),
                 "What the block does (marks), and the boundaries for a rigid one (grey).");
  report.claims(
      {{"2 % beside the boundaries of statics, tan φ = tan a and b/h = tan a, blocks do what the chart says.",
        statics, fmt::format("{}; {}", tallies[0].text(), tallies[1].text())},
       {"2 % beside the boundaries of blocks in motion they do what a rigid block does.", inertia,
        fmt::format("{}; {}", tallies[2].text(), tallies[3].text())},
       {"So they do on the grid.", tallies[4].n_right == tallies[4].n, tallies[4].text()}});
}

}  // namespace validation
