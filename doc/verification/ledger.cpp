#include "mechanics_chapters.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/chart.hpp>
#include <ddacontact/picture/picture.hpp>

#include <algorithm>
#include <cmath>

namespace verification {

namespace {

/// A block falls upon the floor, bounces, slides, hits a second one, and both come to rest; damping
/// everywhere.
Scene everything() {
  Scene scene = rock_scene(0.002, 1000);
  scene.analysis.damping = {0.2, 1e-5};
  scene.joints[0].friction_angle = 25;
  scene.joints[0].restitution = 0.4;
  scene.joints[0].dashpot = 0.1;
  scene.blocks = {block(rectangle(-2, -1, 14, 1), true), block(turned(rectangle(-0.5, -0.5, 1, 1), 0.1)),
                  block(rectangle(3, 0, 1, 1.5))};
  scene.blocks[1].vertices.colwise() += Vec2(0, 1);
  scene.blocks[1].velocity = {6, 0};
  return scene;
}

}  // namespace

void energy_ledger(Report& report) {
  report.heading("7. The energy ledger");
  report.paragraph(
      "A square is thrown along the floor from a height of half a metre, hits it with a corner, bounces (e = "
      "0.4) and slides (φ = 25 degrees). It hits a second block, and both come to rest. Rayleigh damping "
      "(0.2 1/s, 1e-5 s) and contact dashpots (0.1) act throughout. Each line below is computed from its own "
      "definition; together with gravity they must add up to what there was at the start.");
  const BuiltScene built = build(everything());
  Stepper& stepper = *built.stepper;
  struct Entry {
    const char* name;
    double Energy::*value;
  };
  constexpr Entry entries[] = {{"kinetic", &Energy::kinetic},
                               {"elastic", &Energy::elastic},
                               {"gravity", &Energy::gravity},
                               {"lost by friction", &Energy::friction_dissipated},
                               {"lost by the scheme", &Energy::numerical_dissipated},
                               {"lost by damping and impacts", &Energy::damping_dissipated}};
  Chart chart{
      .x_symbol = {"t", "", ""}, .y_symbol = {"energy", "", ""}, .x_unit = "s", .y_unit = "J", .series = {}};
  for (const Entry& entry : entries) chart.series.push_back({entry.name, {}, {}});
  chart.series.push_back({"sum", {}, {}});
  Chart balance{.x_symbol = {"t", "", ""},
                .y_symbol = {"balance error", "", ""},
                .x_unit = "s",
                .y_unit = "",
                .series = {{"|sum - start| / exchanged", {}, {}}},
                .y_logarithmic = true};
  std::vector<Frame> frames{capture_frame(stepper, built.labels, {})};
  double worst = 0;
  for (int k = 1; k <= 1000; ++k) {
    run(stepper, 1);
    const double time = stepper.state().time;
    const Energy& now = stepper.energy().now;
    for (std::size_t e = 0; e < std::size(entries); ++e) {
      chart.series[e].x.push_back(time);
      chart.series[e].y.push_back(now.*entries[e].value);
    }
    chart.series.back().x.push_back(time);
    chart.series.back().y.push_back(now.total());
    balance.series[0].x.push_back(time);
    balance.series[0].y.push_back(std::abs(stepper.energy().balance_error()));
    worst = std::max(worst, std::abs(stepper.energy().balance_error()));
    if (k == 150 || k == 300 || k == 1000) frames.push_back(capture_frame(stepper, built.labels, {}));
  }
  std::vector<Panel> panels;
  for (const Frame& frame : frames)
    panels.push_back({.frame = &frame, .caption = fmt::format("{:.1f} s", frame.time)});
  report.picture("mechanics_ledger_scene",
                 draw(panels, {.title = "Fall, hit, slide, stop", .width = 900, .columns = 2}),
                 "The scene at four moments.");
  report.picture("mechanics_ledger",
                 draw({chart, balance}, {.title = "Where the energy goes", .plot_height = 260}),
                 "Above: the entries of the ledger and their sum (J per metre of thickness). Below: what the "
                 "sum is off by, over the "
                 "energy exchanged so far.");
  report.claims({{"The ledger closes to 1e-6 of the energy exchanged.", worst <= 1e-6, text(worst)},
                 {"The blocks come to rest.", stepper.energy().now.kinetic <= 1e-6,
                  fmt::format("{} J left of {:.0f}", text(stepper.energy().now.kinetic), 2500. * 36 / 2)}});
  report.paragraph(
      "A test (`EnergyLedger.OpensWhenAForceIsWrong`) gives a block an elastic force that is 1 % off its "
      "energy, and sees the ledger "
      "open by as much.");
}

}  // namespace verification
