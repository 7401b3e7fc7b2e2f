/// \file A slope of columns that topple.
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/picture.hpp>
#include <ddacontact/study/strength_reduction.hpp>
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

constexpr double density = 2500;    // kg/m3, of rock_scene
constexpr double time_step = 0.05;  // s
constexpr int settling_steps = 20;
constexpr double least_time = 10, most_time = 60;  // s, that a slope is watched
constexpr double at_rest = 1e-6;                   // m/s
constexpr int treads_beyond = 3;                   // below the toe and above the uppermost column

/// Whether a column's foot touches the riser behind it, or its uphill corner is drawn in by so much of the
/// width: the formula knows no forces there.
enum class Foot { free, held };
constexpr double gap = 1e-4;

int block_of(const Slope& slope, int column) {
  return slope.n_columns + 2 * treads_beyond + column - 1;
}

int tread_of(int column) {
  return column - 1 + treads_beyond;
}

Scene slope_scene(const Slope& slope, double friction_angle, Foot foot) {
  Scene scene = rock_scene(time_step, static_cast<int>(std::lround(most_time / time_step)));
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
    if (foot == Foot::free) column(0, 1) -= gap * slope.width;
    add(column, false);
  }
  scene.stages = {scene.stage("settle"), scene.stage("watch")};
  scene.stages[0].analysis.mode = Mode::statics;
  scene.stages[0].analysis.steps = settling_steps;
  return scene;
}

/// Carries a slope on until a vertex has moved by `displacement`: true; until it has come to rest, or
/// most_time: false.
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

Critical critical(const Slope& slope, Foot foot) {
  const auto moves_with = [&](double friction_angle) {
    return moves(*build(slope_scene(slope, friction_angle, foot)).stepper, fallen(slope));
  };
  Critical found;
  found.limit = critical_angle(slope);
  double low = found.limit - 0.5, high = found.limit + 0.5;
  found.within_bar = moves_with(low) && !moves_with(high);
  while (found.within_bar && high - low > 0.02) {
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

/// The critical friction angle by the factor of safety of the slope at 45 degrees, as `dda safety` finds it.
double reduced_angle(const Slope& slope) {
  const StrengthReduction reduction(slope_scene(slope, 45, Foot::free), {0});
  const FactorBracket factor = bracket_factor(
      [&](double tried) { return reduction.try_factor(tried).verdict; }, FactorRange{1, 3}, 0.002);
  return std::atan(2 / (factor.low + factor.high)) / radians(1);
}

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

/// The largest force of a riser on a foot over the largest between columns, of a slope that just rests.
double grip(const Slope& slope, double friction_angle) {
  const BuiltScene built = build(slope_scene(slope, friction_angle, Foot::held));
  moves(*built.stepper, fallen(slope));
  double at_riser = 0, between = 0;
  for (int k = 1; k <= slope.n_columns; ++k) {
    const int b = block_of(slope, k);
    at_riser = std::max(at_riser, normal_force_between(*built.stepper, b, tread_of(k + 1)));
    if (k > 1) between = std::max(between, normal_force_between(*built.stepper, b, b - 1));
  }
  return at_riser / between;
}

/// How far the forces between columns are from the formula's at most, over the largest.
double force_error(const Stepper& stepper, const Slope& slope, double friction_angle) {
  const std::vector<Need> need = needs(slope, friction_angle);
  double largest = 0, difference = 0;
  for (int k = 2; k <= slope.n_columns; ++k) {
    const double force = density * gravity * need[k].force;
    largest = std::max(largest, force);
    difference =
        std::max(difference,
                 std::abs(normal_force_between(stepper, block_of(slope, k), block_of(slope, k - 1)) - force));
  }
  return difference / largest;
}

}  // namespace

void goodman_bray(Report& report) {
  report.heading("A toppling slope");
  report.paragraph(
      "Columns of width Δx on a stepped base whose treads fall by ψ towards the toe; a tall column leans on "
      "the next "
      "lower one, the lowest ones may slide. Limit equilibrium (Goodman and Bray 1976): from the top down, "
      "column n "
      "pushes on the next with what keeps it from toppling or from sliding, whichever is more,");
  report.paragraph(
      "P(n−1) = [P(n) (M − Δx μ) + W/2 (y sin ψ − Δx cos ψ)] / L  or  P(n) − W (μ cos ψ − sin ψ)/(1 − μ²),");
  report.paragraph(
      "with M and L the heights at which P(n) and P(n−1) act, at the upper ends of the common faces. The "
      "slope is at "
      "its limit when the toe needs no support. The columns are rigid in the formula, elastic here (E = 35 "
      "GPa, "
      "Wachspress's functions, four corners). 20 static steps settle them, then they may move, Δt = 0.05 s. "
      "A slope moves "
      "when a vertex has moved by Δx/20, and rests when it has come to rest instead; the friction angle "
      "between them is "
      "found by bisection.");
  report.paragraph(
      "The formula knows the forces between columns and on their bases, not those of the riser behind a "
      "column's foot. So the lower uphill corner of every column is drawn in by 1e-4 Δx (feet free). Where "
      "it touches the riser (feet held), the foot is caught between the edge of its tread and the riser. "
      "Friction holds it down there, and the slope may rest a little below its limit. *Strength reduction* "
      "is the angle that the factor of safety of the slope with 45° and free feet gives, as `dda safety` "
      "finds it:");
  std::vector<std::vector<std::string>> rows{{"slope", "columns", "Δx, m", "ψ", "limit", "feet free", "error",
                                              "s", "feet held", "error", "riser's force, of the largest P",
                                              "strength reduction", "error"}};
  bool within_bar = true, as_told = true;
  double worst = 0, worst_force = 0, worst_reduced = 0;
  std::string behaviours;
  std::vector<Frame> frames;
  for (const Slope& slope : slopes) {
    Critical free;
    const double seconds = seconds_of([&] { free = critical(slope, Foot::free); });
    const Critical held = critical(slope, Foot::held);
    const double reduced = reduced_angle(slope);
    const double rests_at = free.computed + 0.02, moves_at = free.limit - 0.5;
    rows.push_back({slope.name, std::to_string(slope.n_columns), text(slope.width),
                    fmt::format("{:g}°", slope.tread_dip), fmt::format("{:.2f}°", free.limit),
                    fmt::format("{:.2f}°", free.computed), fmt::format("{:+.2f}°", free.error()),
                    fmt::format("{:.1f}", seconds), fmt::format("{:.2f}°", held.computed),
                    fmt::format("{:+.2f}°", held.error()), text(grip(slope, held.computed + 0.02)),
                    fmt::format("{:.2f}°", reduced), fmt::format("{:+.2f}°", reduced - free.limit)});
    worst_reduced = std::max(worst_reduced, std::abs(reduced - free.limit));
    within_bar = within_bar && free.within_bar;
    worst = std::max(worst, std::abs(free.error()));

    const BuiltScene resting = build(slope_scene(slope, rests_at, Foot::free)),
                     moving = build(slope_scene(slope, moves_at, Foot::free));
    moves(*resting.stepper, fallen(slope));
    worst_force = std::max(worst_force, force_error(*resting.stepper, slope, rests_at));
    frames.push_back(capture_frame(*resting.stepper, resting.labels, {}));
    moves(*moving.stepper, fallen(slope));
    const std::vector<Need> below = needs(slope, moves_at);
    const std::string seen =
        told(slope.n_columns, [&](int k) { return behaviour_of(*moving.stepper, slope, k); });
    as_told = as_told && seen == told(slope.n_columns, [&](int k) { return below[k].behaviour; });
    behaviours += fmt::format("{}{}: {}", behaviours.empty() ? "" : "; ", slope.name, seen);
    moves(*moving.stepper, slope.width);
    frames.push_back(capture_frame(*moving.stepper, moving.labels, {}));
  }
  report.table(rows);
  report.picture(
      "dda_goodman_bray",
      draw({{.frame = &frames[0], .field = Field::s2, .caption = "rests, just above the limit"},
            {.frame = &frames[1], .caption = "half a degree below"}},
           {.title = "Goodman and Bray's slope",
            .width = 950,
            .columns = 2,
            .vectors = {VectorKind::contact_forces}}),
      "σ2 and contact forces of the slope that just rests, and the way it moves with less friction.");
  const double book = critical_angle(slopes[0]);
  report.claims({{"The formula gives the book's 38.15° for its example.", std::abs(book - 38.15) < 0.005,
                  fmt::format("{:.3f}°", book)},
                 {"Every slope moves half a degree below its limit and rests half a degree above.",
                  within_bar, fmt::format("critical friction angle within {:.2f}°", worst)},
                 {"Strength reduction finds the critical angle within 0.3° (feet free).",
                  worst_reduced <= 0.3, fmt::format("{:.2f}°", worst_reduced)},
                 {"Just above the limit the columns push on each other as the formula has it, within 5 % of "
                  "the largest force.",
                  worst_force < 0.05, text(worst_force)},
                 {"Half a degree below it those columns topple, and those slide, that the formula says.",
                  as_told, behaviours}});
}

}  // namespace validation
