/// \file The least thickness of a semicircular arch.
#include "arch_limit.hpp"
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/chart.hpp>
#include <ddacontact/picture/picture.hpp>
#include <mechanics_scenes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace validation {

namespace {

using namespace verification;

constexpr double radius = 10;                      // m, mean
constexpr double fallen = radius / 50;             // m: what has moved so far does not come back
constexpr double least_time = 10, most_time = 60;  // s, that an arch is watched
constexpr double at_rest = 1e-6;                   // m/s
constexpr int settling_steps = 20;
constexpr double much_friction = 0.7, standard_step = 0.02, rock = 35e9;

struct Arch {
  int n_voussoirs = 0;
  double friction = much_friction;
  double time_step = standard_step;
  double young = rock;
  bool settled = true;  ///< statically, before it may move
};

/// A wide held block below, then the voussoirs from the right springing on.
Scene arch_scene(const Arch& arch, double thickness) {
  Scene scene =
      rock_scene(arch.time_step, static_cast<int>(std::lround(most_time / arch.time_step)), arch.young);
  scene.joints[0].friction_angle = std::atan(arch.friction) * 360 / turn;
  scene.blocks = {block(rectangle(-1.5 * radius, -0.2 * radius, 3 * radius, 0.2 * radius), true)};
  const double inner = radius * (1 - thickness / 2), outer = radius * (1 + thickness / 2);
  for (int k = 0; k < arch.n_voussoirs; ++k) {
    const double from = std::numbers::pi * k / arch.n_voussoirs,
                 to = std::numbers::pi * (k + 1) / arch.n_voussoirs;
    const Vec2 a(std::cos(from), std::sin(from)), b(std::cos(to), std::sin(to));
    Points voussoir(2, 4);
    voussoir << inner * a, outer * a, outer * b, inner * b;
    scene.blocks.push_back(block(voussoir));
  }
  if (arch.settled) {
    scene.stages = {scene.stage("settle"), scene.stage("watch")};
    scene.stages[0].analysis.mode = Mode::statics;
    scene.stages[0].analysis.steps = settling_steps;
  }
  return scene;
}

double largest_displacement(const Stepper& stepper) {
  return stepper.blocks().displacements(stepper.state()).colwise().norm().maxCoeff();
}

double fastest(const Stepper& stepper) {
  return stepper.state().velocity.cwiseAbs().maxCoeff();
}

/// Carries an arch on until a vertex has moved by `displacement`: true; until it has come to rest, or
/// most_time: false.
bool moves(Stepper& stepper, double displacement) {
  while (stepper.state().time < most_time) {
    run(stepper, 1);
    if (largest_displacement(stepper) > displacement) return true;
    if (stepper.state().time > least_time && fastest(stepper) < at_rest) return false;
  }
  return false;
}

bool stands(const Arch& arch, double thickness) {
  return !moves(*build(arch_scene(arch, thickness)).stepper, fallen);
}

struct Least {
  double limit = 0, computed = 0;  ///< t/R
  bool within_bar = false;         ///< falls 3 % below the limit and stands 3 % above it
  double error() const { return computed / limit - 1; }
};

/// Bisection from 3 % below to 3 % above the limit; outside of them it is not looked for.
/// \param[in] resolution  of the limit
Least least_that_stands(const Arch& arch, double resolution) {
  Least found;
  found.limit = least_thickness(arch.n_voussoirs, arch.friction);
  double low = 0.97 * found.limit, high = 1.03 * found.limit;
  found.within_bar = !stands(arch, low) && stands(arch, high);
  while (found.within_bar && high - low > resolution * found.limit) {
    const double tried = (low + high) / 2;
    (stands(arch, tried) ? high : low) = tried;
  }
  found.computed = (low + high) / 2;
  return found;
}

std::string percent(double part) {
  return fmt::format("{:.2f} %", 100 * part);
}

/// Where the normal force of each joint passes, over half the thickness: 1 at the outer edge.
std::vector<double> eccentricities(const Frame& frame, double thickness) {
  const int n = frame.n_blocks() - 1;
  std::vector<double> normal(n + 1, 0), moment(n + 1, 0);
  for (const FrameContact& contact : frame.contacts) {
    const auto [low, high] = std::minmax(contact.vertex_block, contact.edge_block);
    const int joint = low > 0 ? low : high == 1 ? 0 : n;
    normal[joint] += contact.normal_force;
    moment[joint] += contact.normal_force * (contact.position.norm() - radius);
  }
  std::vector<double> found;
  for (int k = 0; k <= n; ++k) found.push_back(moment[k] / normal[k] / (radius * thickness / 2));
  return found;
}

struct Picture {
  Frame standing, falling;
  double difference = 0;  ///< of eccentricities of what stands from the limit analysis, at most
};

/// Just above the least thickness that stands, and 3 % below the limit.
Picture look(const Arch& arch, const Least& least) {
  const auto frame_after = [&](double thickness) {
    const BuiltScene built = build(arch_scene(arch, thickness));
    moves(*built.stepper, radius / 4);
    return capture_frame(*built.stepper, built.labels, {});
  };
  const double thickness = 1.002 * least.computed;
  Picture seen{frame_after(thickness), frame_after(0.97 * least.limit)};
  const std::vector<double> computed = eccentricities(seen.standing, thickness);
  const std::vector<ArchJoint> limit = joints_that_hold({arch.n_voussoirs, least.limit}, arch.friction);
  for (std::size_t k = 0; k < computed.size(); ++k)
    seen.difference = std::max(seen.difference, std::abs(computed[k] - limit[k].eccentricity));
  return seen;
}

void voussoirs(Report& report) {
  std::vector<std::vector<std::string>> rows{
      {"voussoirs", "limit, arcs", "limit, trapezoids", "computed", "error", "s"}};
  bool within_bar = true;
  double worst = 0;
  for (const int n : {7, 11, 15, 31}) {
    Least least;
    const double seconds = seconds_of([&] { least = least_that_stands({n}, 5e-4); });
    rows.push_back({std::to_string(n), fmt::format("{:.4f}", least_thickness(n, much_friction, true)),
                    fmt::format("{:.4f}", least.limit), fmt::format("{:.4f}", least.computed),
                    percent(least.error()), fmt::format("{:.1f}", seconds)});
    within_bar = within_bar && least.within_bar;
    worst = std::max(worst, std::abs(least.error()));
  }
  report.paragraph(fmt::format("Least t/R with μ = {}, and the run time of the bisection:", much_friction));
  report.table(rows);
  const double many = least_thickness(301, much_friction), seven = least_thickness(7, much_friction, true);
  report.claims({{"The limit analysis gives the known 0.1075 for many joints and 0.0963 for seven voussoirs.",
                  std::abs(many - 0.1075) < 1e-4 && std::abs(seven - 0.0963) < 1e-4,
                  fmt::format("{:.5f} for 301, {:.5f} for 7", many, seven)},
                 {"7, 11, 15 and 31 voussoirs fall 3 % below the limit and stand 3 % above it.", within_bar,
                  fmt::format("least thickness within {}", percent(worst))}});
}

void frictions(Report& report) {
  Chart chart{.x_symbol = {"coefficient of friction μ", "", ""},
              .y_symbol = {"least t/R", "", ""},
              .x_unit = "",
              .y_unit = "",
              .series = {}};
  std::vector<std::vector<std::string>> rows{{"μ", "many joints, limit", "published", "11 voussoirs, limit",
                                              "computed", "error", "31 voussoirs, limit", "computed",
                                              "error"}};
  const std::vector<int> numbers{11, 31};
  for (const int n : numbers) {
    Series limit{fmt::format("{} voussoirs, limit analysis", n), {}, {}};
    for (double mu = 0.33; mu < 0.4405; mu += 0.002) {
      limit.x.push_back(mu);
      limit.y.push_back(least_thickness(n, mu));
    }
    chart.series.push_back(limit);
  }
  for (const int n : numbers) {
    chart.series.push_back(
        {.name = fmt::format("{} voussoirs, computed", n), .x = {}, .y = {}, .markers = true});
  }
  struct Known {
    double friction, published;
  };
  bool within_bar = true, grows = true;
  double worst = 0, worst_published = 0;
  std::vector<double> before(numbers.size(), 1);
  for (const Known& known : {Known{0.34, 0.1628}, {0.36, 0.1416}, {0.38, 0.1217}, {0.42, 0.1075}}) {
    const double many = least_thickness(301, known.friction);
    worst_published = std::max(worst_published, std::abs(many / known.published - 1));
    std::vector<std::string> row{text(known.friction), fmt::format("{:.4f}", many),
                                 fmt::format("{:.4f}", known.published)};
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const Least least = least_that_stands({numbers[k], known.friction}, 1e-3);
      within_bar = within_bar && least.within_bar;
      worst = std::max(worst, std::abs(least.error()));
      grows = grows && least.computed < before[k];
      before[k] = least.computed;
      Series& computed = chart.series[numbers.size() + k];
      computed.x.push_back(known.friction);
      computed.y.push_back(least.computed);
      row.push_back(fmt::format("{:.4f}", least.limit));
      row.push_back(fmt::format("{:.4f}", least.computed));
      row.push_back(percent(least.error()));
    }
    rows.push_back(row);
  }
  report.paragraph("### Less friction");
  report.paragraph("Below about μ = 0.40 the springings slide outwards before the fifth hinge opens:");
  report.table(rows);
  report.picture("dda_arch_friction", draw({chart}, {.title = "Semicircular arch", .plot_height = 300}),
                 "Least thickness over mean radius that stands, over friction.");
  report.claims(
      {{"The limit analysis gives the published growth below μ = 0.40 within 0.5 %.", worst_published < 5e-3,
        percent(worst_published)},
       {"The computed least thickness follows it within 3 %.", within_bar && grows, percent(worst)}});
}

void error_of_what(Report& report) {
  report.paragraph("### Error against time step, stiffness and the way it is loaded");
  report.paragraph(
      "7 voussoirs; bisection to 1e-4. Under sudden gravity the arch spreads further than under its weight "
      "at rest, "
      "and has to stand more: the less, the stiffer it is, and the more the time step damps.");
  std::vector<std::vector<std::string>> rows{
      {"E, GPa", "Δt, s", "settled: t/R", "error", "s", "sudden gravity: t/R", "error", "s"}};
  double worst = 0, rigid = 0;
  for (const Arch& of : {Arch{7, much_friction, 0.04},
                         {7},
                         {7, much_friction, 0.01},
                         {7, much_friction, 0.005},
                         {7, much_friction, standard_step, 3.5e9},
                         {7, much_friction, standard_step, 350e9},
                         {7, much_friction, standard_step, 3500e9}}) {
    std::vector<std::string> row{fmt::format("{:g}", of.young / 1e9), fmt::format("{:g}", of.time_step)};
    for (const bool settled : {true, false}) {
      Arch arch = of;
      arch.settled = settled;
      Least least;
      const double seconds = seconds_of([&] { least = least_that_stands(arch, 1e-4); });
      row.push_back(fmt::format("{:.5f}", least.computed));
      row.push_back(percent(least.error()));
      row.push_back(fmt::format("{:.1f}", seconds));
      if (settled) worst = std::max(worst, std::abs(least.error()));
      rigid = std::abs(least.error());
    }
    rows.push_back(row);
  }
  report.table(rows);
  report.claims(
      {{"Settled, it is the limit of rigid blocks to 0.2 %, whatever the time step and the stiffness.",
        worst < 2e-3, percent(worst)},
       {"Under sudden gravity it is so to 0.05 % when blocks are a hundred times as stiff as rock.",
        rigid < 5e-4, fmt::format("{:.4f} %", 100 * rigid)}});
}

void pictures(Report& report) {
  const Arch rough{15}, smooth{15, 0.34};
  const Picture hinges = look(rough, least_that_stands(rough, 1e-3));
  const Picture slides = look(smooth, least_that_stands(smooth, 1e-3));
  report.picture(
      "dda_arch",
      draw({{.frame = &hinges.standing, .field = Field::s2, .caption = "μ = 0.7, the least thickness"},
            {.frame = &slides.standing, .field = Field::s2, .caption = "μ = 0.34, the least thickness"},
            {.frame = &hinges.falling, .caption = "μ = 0.7, 3 % below the limit"},
            {.frame = &slides.falling, .caption = "μ = 0.34, 3 % below the limit"}},
           {.title = "15 voussoirs",
            .width = 900,
            .columns = 2,
            .window = Window{{-1.25 * radius, -0.08 * radius}, {1.25 * radius, 1.12 * radius}},
            .vectors = {VectorKind::contact_forces}}),
      "Above: σ2 and contact forces of arches that just stand. The thrust touches the outer edge at the "
      "crown and the inner one at the haunches. With much friction also the outer one at the springings, "
      "with little it is as oblique there as friction allows. Below: how thinner ones fall, by hinges, and "
      "by hinges and sliding at the springings.");
  report.claims(
      {{"At the least thickness the thrust passes every joint where the limit analysis has it, within a "
        "tenth "
        "of half the thickness.",
        std::max(hinges.difference, slides.difference) < 0.1,
        fmt::format("{} with μ = 0.7, {} with 0.34", text(hinges.difference), text(slides.difference))}});
}

}  // namespace

void arch(Report& report) {
  report.heading("A semicircular arch");
  report.paragraph(
      "A semicircular arch of equal trapezoidal voussoirs with radial joints stands on a wide base under its "
      "own weight. Its mean radius is R = 10 m, its thickness t; E = 35 GPa, Δt = 0.02 s. 20 static steps "
      "settle it, then it may move. It falls when a vertex has moved by R/50, and stands when it has come to "
      "rest instead. The least t/R that stands is found by bisection.");
  report.paragraph(
      "The reference is a limit analysis of rigid voussoirs. It asks: is there a horizontal thrust H and a "
      "moment M at the springing such that at every joint |M| ≤ N t/2 and |T| ≤ μ N? Both are linear in (H, "
      "M); the half planes are intersected exactly, and t is bisected. (Milankovitch 1907; with little "
      "friction a necessary condition, since sliding does not dilate.)");
  voussoirs(report);
  frictions(report);
  pictures(report);
  error_of_what(report);
}

}  // namespace validation
