/// \file A slope of columns that topple.
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/picture.hpp>
#include <mechanics_scenes.hpp>

#include <algorithm>
#include <cmath>

namespace validation {

namespace {

using namespace verification;

/// Columns of one width on a stepped base, numbered from 1 at the toe. Lengths in m; along the base's treads
/// and across them.
struct Slope {
  const char* name;
  int n_columns, crest;  ///< the column at the crest
  double width;          ///< Δx
  double tread_dip;      ///< degrees, towards the toe
  double step;           ///< b: each tread lies so much higher than the one below
  double rise, fall;     ///< a1, a2: of the tops from column to column, below and above the crest
};

/// Their heights, from 1.
std::vector<double> heights(const Slope& slope) {
  std::vector<double> height{0};
  for (int k = 1; k <= slope.n_columns; ++k)
    height.push_back(k <= slope.crest ? k * (slope.rise - slope.step)
                                      : height.back() - slope.fall - slope.step);
  return height;
}

enum class Behaviour { rests, topples, slides };

const char* name(Behaviour behaviour) {
  return behaviour == Behaviour::rests ? "rest" : behaviour == Behaviour::topples ? "topple" : "slide";
}

/// What column k needs from below and why.
struct Need {
  double force = 0;  ///< P of (k - 1), N per m and unit weight; for column 1 only its sign has a meaning
  Behaviour behaviour = Behaviour::rests;
};

/// Goodman and Bray (1976): from the uppermost column down, each pushes on the next with what it takes to
/// keep it from toppling about its lower corner, or from sliding, whichever is more; friction is used up on
/// its sides and, where it slides, below it.
std::vector<Need> needs(const Slope& slope, double friction_angle) {
  const double mu = std::tan(radians(friction_angle)), s = std::sin(radians(slope.tread_dip)),
               c = std::cos(radians(slope.tread_dip));
  const std::vector<double> height = heights(slope);
  std::vector<Need> needs(slope.n_columns + 1);
  double from_above = 0;
  for (int k = slope.n_columns; k >= 1; --k) {
    const double y = height[k], weight = y * slope.width;
    const double upper = k < slope.crest ? y : y - slope.fall, lower = k > slope.crest ? y : y - slope.rise;
    const double turning = from_above * (upper - slope.width * mu) + 0.5 * weight * (y * s - slope.width * c);
    const double toppling = k == 1 ? turning / y : turning / lower;
    const double sliding = from_above - weight * (mu * c - s) / (1 - mu * mu);
    if (toppling > 0 || sliding > 0)
      needs[k] = {std::max(toppling, sliding), toppling > sliding ? Behaviour::topples : Behaviour::slides};
    else if (k == 1)
      needs[k].force = std::max(toppling, sliding);
    from_above = std::max(needs[k].force, 0.);
  }
  return needs;
}

/// The friction angle at which the toe needs no help, degrees.
double critical_angle(const Slope& slope) {
  double moves = 1, rests = 44;
  while (rests - moves > 1e-6) {
    const double tried = (moves + rests) / 2;
    (needs(slope, tried)[1].force > 0 ? moves : rests) = tried;
  }
  return rests;
}

constexpr int treads_beyond = 3;                   // below the toe and above the uppermost column
constexpr double least_time = 10, most_time = 60;  // s, that a slope is watched
constexpr double at_rest = 1e-6;                   // m/s

constexpr double time_step = 0.05;  // s

/// Of neighbouring columns: where the formula has it, at the upper end of what they share; their faces gape
/// below, at the bottom by so much of the width | whole faces.
enum class Touching { corners, faces };
constexpr double gape = 1e-4;

int block_of(const Slope& slope, int column) {
  return slope.n_columns + 2 * treads_beyond + column - 1;
}

Scene slope_scene(const Slope& slope, double friction_angle, Touching touching) {
  Scene scene = rock_scene(time_step, 1);
  scene.joints[0].friction_angle = friction_angle;
  const auto at = [&](int column, double bottom, double height) {
    return rectangle((column - 1) * slope.width, bottom, slope.width, height);
  };
  const auto add = [&](const Points& polygon, bool fixed) {
    scene.blocks.push_back(block(turned(polygon, radians(slope.tread_dip)), fixed));
  };
  for (int k = 1 - treads_beyond; k <= slope.n_columns + treads_beyond; ++k)
    add(at(k, k * slope.step - slope.width, slope.width), true);
  const std::vector<double> height = heights(slope);
  for (int k = 1; k <= slope.n_columns; ++k) {
    Points column = at(k, k * slope.step, height[k]);
    if (touching == Touching::corners) {
      if (k < slope.crest) column(0, 1) -= gape * slope.width;
      if (k > slope.crest) column(0, 0) += gape * slope.width;
    }
    add(column, false);
  }
  return scene;
}

/// Carries a slope on until a vertex has moved by `displacement`: true; or it has come to rest: false.
bool moves(Stepper& stepper, double displacement) {
  while (stepper.state().time < most_time) {
    run(stepper, 1);
    const BlockState& state = stepper.state();
    if (stepper.blocks().displacements(state).colwise().norm().maxCoeff() > displacement) return true;
    if (state.time > least_time && state.velocity.cwiseAbs().maxCoeff() < at_rest) return false;
  }
  return false;
}

double fallen(const Slope& slope) {
  return 0.05 * slope.width;
}

struct Critical {
  double limit = 0, computed = 0;  ///< degrees
  bool within_bar = false;         ///< moves half a degree below the limit and rests half a degree above
  double error() const { return computed - limit; }
};

Critical critical(const Slope& slope, Touching touching) {
  const auto moves_with = [&](double friction_angle) {
    return moves(*build(slope_scene(slope, friction_angle, touching)).stepper, fallen(slope));
  };
  Critical found;
  found.limit = critical_angle(slope);
  double low = found.limit - 0.5, high = found.limit + 0.5;
  found.within_bar = moves_with(low) && !moves_with(high);
  while (found.within_bar && high - low > 0.01) {
    const double tried = (low + high) / 2;
    (moves_with(tried) ? low : high) = tried;
  }
  found.computed = (low + high) / 2;
  return found;
}

constexpr Slope slopes[] = {
    {"Goodman and Bray's", 16, 10, 10, 30, 1, 5, 5},
    {"B", 9, 6, 4, 25, 0.5, 2.4, 1.5},
    {"C", 12, 9, 6, 35, 0.3, 2.2, 3},
};

Behaviour behaviour_of(const Stepper& stepper, const Slope& slope, int column) {
  const int b = block_of(slope, column);
  if (std::abs(stepper.state().rotation[b]) > 1e-3) return Behaviour::topples;
  return travel(stepper, b).norm() > 1e-3 * slope.width ? Behaviour::slides : Behaviour::rests;
}

/// "1-3 slide, 4-13 topple, 14-16 rest"
template <class Of>
std::string told(int n_columns, const Of& behaviour) {
  std::string text;
  for (int first = 1, last = 1; first <= n_columns; first = ++last) {
    while (last < n_columns && behaviour(last + 1) == behaviour(first)) ++last;
    text += fmt::format("{}{} {}", first > 1 ? ", " : "",
                        last > first ? fmt::format("{}-{}", first, last) : fmt::format("{}", first),
                        name(behaviour(first)));
  }
  return text;
}

}  // namespace

void goodman_bray(Report& report) {
  report.heading("A toppling slope");
  report.paragraph(
      "Columns of width Δx on a stepped base whose treads fall towards the toe; a tall column leans on the "
      "next lower "
      "one, the lowest ones may slide. Limit equilibrium (Goodman and Bray 1976): from the top down, column "
      "n pushes on "
      "the next with what keeps it from toppling or from sliding, whichever is more,");
  report.paragraph(
      "P(n−1) = [P(n) (M − Δx μ) + W/2 (y sin ψ − Δx cos ψ)] / L  or  P(n) − W (μ cos ψ − sin ψ)/(1 − μ²),");
  report.paragraph(
      "with M and L the heights at which P(n) and P(n−1) act, at the upper end of the common faces. The "
      "slope is at its "
      "limit when the toe needs no support. The columns are rigid in the formula, elastic here (E = 35 GPa, "
      "Wachspress's "
      "functions, four corners); gravity comes suddenly, Δt = 0.05 s. A slope moves when a vertex has moved "
      "by Δx/20, and "
      "rests when it has come to rest instead; the friction angle between them is found by bisection. The "
      "faces of neighbours gape by 1e-4 Δx at the bottom, so that they meet where the formula has their "
      "forces.");
  std::vector<std::vector<std::string>> rows{
      {"slope", "columns", "Δx, m", "ψ", "limit", "computed", "error", "s", "flush faces", "error"}};
  bool within_bar = true, as_told = true;
  double worst = 0, worst_force = 0;
  std::string behaviours;
  std::vector<Frame> frames;
  for (const Slope& slope : slopes) {
    Critical corners;
    const double seconds = seconds_of([&] { corners = critical(slope, Touching::corners); });
    const Critical faces = critical(slope, Touching::faces);
    rows.push_back({slope.name, std::to_string(slope.n_columns), fmt::format("{:g}", slope.width),
                    fmt::format("{:g}°", slope.tread_dip), fmt::format("{:.2f}°", corners.limit),
                    fmt::format("{:.2f}°", corners.computed), fmt::format("{:+.2f}°", corners.error()),
                    fmt::format("{:.1f}", seconds), fmt::format("{:.2f}°", faces.computed),
                    fmt::format("{:+.2f}°", faces.error())});
    within_bar = within_bar && corners.within_bar;
    worst = std::max(worst, std::abs(corners.error()));

    const double rests_at = corners.computed + 0.02, moves_at = corners.limit - 0.5;
    const BuiltScene at_rest = build(slope_scene(slope, rests_at, Touching::corners)),
                     moving = build(slope_scene(slope, moves_at, Touching::corners));
    moves(*at_rest.stepper, fallen(slope));
    moves(*moving.stepper, fallen(slope));
    const std::vector<Need> at_limit = needs(slope, rests_at), below = needs(slope, moves_at);
    double largest = 0, difference = 0;
    for (int k = 2; k <= slope.n_columns; ++k) {
      const double unit_weight = 2500 * gravity, force = unit_weight * at_limit[k].force;
      const int b = block_of(slope, k);
      largest = std::max(largest, force);
      difference = std::max(difference, std::abs(normal_force_between(*at_rest.stepper, b, b - 1) - force));
    }
    worst_force = std::max(worst_force, difference / largest);
    const std::string seen =
        told(slope.n_columns, [&](int k) { return behaviour_of(*moving.stepper, slope, k); });
    as_told = as_told && seen == told(slope.n_columns, [&](int k) { return below[k].behaviour; });
    behaviours += fmt::format("{}{}: {}", behaviours.empty() ? "" : "; ", slope.name, seen);
    frames.push_back(capture_frame(*at_rest.stepper, at_rest.labels, {}));
    moves(*moving.stepper, slope.width);
    frames.push_back(capture_frame(*moving.stepper, moving.labels, {}));
  }
  report.table(rows);
  report.paragraph(
      "With flush faces statics does not say how high a force acts. At a height h above the tread of the "
      "column it "
      "pushes, what it adds to that column's need is in proportion to (h − Δx μ)/(h − b): the lower, the "
      "less. So a slope of flush columns may rest below the limit, and how it was "
      "loaded decides.");
  report.picture(
      "dda_goodman_bray",
      draw({{.frame = &frames[0], .field = Field::s2, .caption = "rests, just above the limit"},
            {.frame = &frames[1], .caption = "half a degree below"}},
           {.title = "Goodman and Bray's slope",
            .width = 950,
            .columns = 2,
            .vectors = {VectorKind::contact_forces}}),
      "σ2 and contact forces of the slope that just rests, and the way it moves with less friction.");
  report.claims({{"The formula gives the book's 38.15° for its example.",
                  std::abs(critical_angle(slopes[0]) - 38.15) < 0.005,
                  fmt::format("{:.3f}°", critical_angle(slopes[0]))},
                 {"Every slope moves half a degree below its limit and rests half a degree above.",
                  within_bar, fmt::format("critical friction angle within {:.2f}°", worst)},
                 {"Just above the limit the columns push on each other as the formula has it, within 5 % of "
                  "the largest force.",
                  worst_force < 0.05, text(worst_force)},
                 {"Below it the columns topple and slide that the formula says.", as_told, behaviours}});
}

}  // namespace validation
