#include "mechanics_chapters.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>

#include <algorithm>
#include <cmath>

namespace verification {

namespace {

constexpr int n_blocks = 100, n_settling = 20;
constexpr int settling_steps = 300;

Scene stack_scene(Scheme scheme, int blocks) {
  Scene scene = rock_scene(0.01, settling_steps);
  scene.analysis.scheme = scheme;
  scene.joints[0].friction_angle = 30;
  scene.blocks = {block(rectangle(-2, -1, 5, 1), true)};
  for (int k = 0; k < blocks; ++k) scene.blocks.push_back(block(rectangle(0, k, 1, 1)));
  return scene;
}

double fastest(const Stepper& stepper) {
  return stepper.state().velocity.cwiseAbs().maxCoeff();
}

void settling(Report& report) {
  report.paragraph("### Settling");
  report.paragraph(
      "Twenty squares of 1 m upon each other, φ = 30 degrees, under sudden gravity, Δt = 0.01 s. The largest "
      "velocity of "
      "any vertex:");
  Chart chart{.x_symbol = {"step", "", ""},
              .y_symbol = {"largest velocity", "", ""},
              .x_unit = "",
              .y_unit = "m/s",
              .series = {},
              .y_logarithmic = true};
  std::vector<std::vector<std::string>> rows{
      {"scheme", "after 50 steps", "100", "200", "300", "solutions a step", "s"}};
  for (const NamedScheme& scheme : schemes) {
    const BuiltScene built = build(stack_scene(scheme.scheme, n_settling));
    Series series{scheme.name, {}, {}};
    std::vector<std::string> row{scheme.name};
    const double seconds = seconds_of([&] {
      for (int k = 1; k <= settling_steps; ++k) {
        if (!built.stepper->step()) break;
        series.x.push_back(k);
        series.y.push_back(fastest(*built.stepper));
        if (k == 50 || k % 100 == 0) row.push_back(text(series.y.back()));
      }
    });
    row.resize(5, "stopped");
    row.push_back(fmt::format(
        "{:.1f}", static_cast<double>(built.stepper->counts().contact_iterations) / settling_steps));
    row.push_back(fmt::format("{:.1f}", seconds));
    rows.push_back(row);
    chart.series.push_back(series);
  }
  report.table(rows);
  report.picture("mechanics_settling",
                 draw({chart}, {.title = "A stack of 20 comes to rest", .plot_height = 260}),
                 "Largest velocity in a stack of 20 (m/s), step by step, by scheme.");
}

std::vector<ContactState> states(const Stepper& stepper) {
  std::vector<ContactState> states;
  for (const ContactRecord& contact : stepper.contacts()) states.push_back(contact.history.state);
  return states;
}

void creeping(Report& report, int steps) {
  const BuiltScene built = build(stack_scene(Scheme::decaying, n_blocks));
  Stepper& stepper = *built.stepper;
  run(stepper, 1000);
  const Points before = stepper.blocks().displacements(stepper.state());
  const std::vector<ContactState> states_before = states(stepper);
  double reaction = 0;
  long flips = 0;
  for (int k = 0; k < steps; ++k) {
    run(stepper, 1);
    flips += states(stepper) != states_before;
    reaction =
        std::max(reaction, std::abs(normal_force_between(stepper, 0, 1) / (n_blocks * 2500 * gravity) - 1));
  }
  const double creep = (stepper.blocks().displacements(stepper.state()) - before).colwise().norm().maxCoeff();
  report.paragraph("### At rest");
  report.paragraph(fmt::format(
      "A stack of a hundred by the decaying scheme, {} steps after 1000 steps of settling. The table has how "
      "far any vertex has moved, the force on the floor against the weight, and the steps in which a "
      "contact's state was another one.",
      steps));
  report.claims({{"Creep is at most 1e-9 of a block.", creep <= 1e-9, fmt::format("{} m", text(creep))},
                 {"The floor carries the weight to 1e-8.", reaction <= 1e-8, text(reaction)},
                 {"No contact changes its state.", flips == 0, fmt::format("{} steps", flips)}});
}

void ratios(Report& report) {
  report.paragraph("### Ratios of a million");
  report.paragraph(
      "Three squares of 1 m upon each other whose densities or moduli differ by 1e6. The table has the "
      "largest error of a contact force, over the weight it carries, after 1100 steps of 0.01 s. It also has "
      "the steps of the last 100 in which a contact's state changes. The springs start at the softest "
      "block's modulus, because a force is resolved to its spring times the last digit of a coordinate. The "
      "default, 40 times the stiffest modulus, times 2e-16 m is 1e-6 of such a light block's weight and "
      "more.");
  struct Kind {
    const char* name;
    double density[3], young[3];  // from below
  };
  constexpr Kind kinds[] = {
      {"heavy on light", {25, 25, 2.5e7}, {35e9, 35e9, 35e9}},
      {"light on heavy", {2.5e7, 25, 25}, {35e9, 35e9, 35e9}},
      {"heavy between light", {25, 2.5e7, 25}, {35e9, 35e9, 35e9}},
      {"stiff on soft", {2500, 2500, 2500}, {35e6, 35e6, 35e12}},
      {"soft on stiff", {2500, 2500, 2500}, {35e12, 35e6, 35e6}},
      {"soft and light on stiff and heavy", {2.5e7, 25, 25}, {35e12, 35e6, 35e6}},
  };
  std::vector<std::vector<std::string>> rows{{"stack", "force, error", "changes of state"}};
  double worst = 0;
  long flips = 0;
  for (const Kind& kind : kinds) {
    Scene scene = stack_scene(Scheme::decaying, 3);
    scene.materials.clear();
    for (int k = 0; k < 3; ++k) {
      scene.materials.push_back({fmt::format("{}", k), kind.density[k], kind.young[k], 0.3});
      scene.blocks[static_cast<std::size_t>(k) + 1].material = k;
    }
    const double softest = *std::min_element(kind.young, kind.young + 3);
    scene.contact.normal_stiffness = softest;
    scene.contact.tangential_stiffness = softest / 2.5;
    double error = 0;
    long changes = 0;
    try {
      const BuiltScene built = build(scene);
      run(*built.stepper, 1000);
      const auto before = states(*built.stepper);
      for (int k = 0; k < 100; ++k) {
        run(*built.stepper, 1);
        changes += states(*built.stepper) != before;
      }
      double weight = 0;
      for (int k = 2; k >= 0; --k) {
        weight += kind.density[k] * gravity;
        error = std::max(error, std::abs(normal_force_between(*built.stepper, k, k + 1) / weight - 1));
      }
      rows.push_back({kind.name, text(error), fmt::format("{}", changes)});
    } catch (const Error& stop) {
      error = 1;
      rows.push_back({kind.name, std::string("stopped ") + stop.what(), ""});
    }
    worst = std::max(worst, error);
    flips += changes;
  }
  report.table(rows);
  report.claims({{"Contact forces are the weights to 1e-6.", worst <= 1e-6, text(worst)},
                 {"No contact changes its state.", flips == 0, fmt::format("{} steps", flips)}});
}

}  // namespace

void resting(Report& report) {
  report.heading("5. Resting");
  settling(report);
  creeping(report, 2000);
  ratios(report);
}

// mechanics_verification DIRECTORY resting_long
void resting_long(Report& report) {
  report.heading("5. Resting, 1e5 steps");
  creeping(report, 100000);
}

}  // namespace verification
