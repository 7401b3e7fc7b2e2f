#include <tests/performance/error_time/page.hpp>

#include <tests/performance/error_time/comparison.hpp>

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>
#include <mechanics_scenes.hpp>
#include <report.hpp>

#include <algorithm>
#include <cmath>

namespace error_time {

namespace {

using ddacontact::Chart;
using ddacontact::Series;
using verification::text;

constexpr const char* front = R"(# Error against run time

What a second of computing buys in whole analyses: the error of the number that a user wants over the time that the steps take.
Compared are the default, the preset `paper`, classical DDA, and the default with one thing changed. Made by
`bash doc/benchmarks/make_dda_accuracy.sh BUILD_DIRECTORY`, figures and verdicts included. Times are the processor's, of the steps
alone: a run on one thread of a quiet machine takes as long. They are medians of 3 to 9 runs unless a run takes more than 2 s. Every
measurement is in [dda_accuracy.csv](dda_accuracy.csv).

)";

constexpr const char* why_behind =
    R"(Where it is behind, the cause is the cost of a step. Step by step it errs less where blocks slide under forces that change, of which it takes the mean, and where they
turn, collide or bear each other. Short waves it damps more. Per step it judges residuals on the geometry at the end of the step and sets the
multipliers anew. It solves with friction that follows the normal force, and finds the velocity at the end from the next step. That of a first
solution after a change of the step counts where there are few. With small steps both come to the way of the elastic blocks, which for the
single one is 5e-7 beyond that of a rigid one. Errors near that are not those of the steps.)";

constexpr const char* what_to_choose =
    R"(- **Nothing stated** where it is not known which of the following matters. Steps take whole impulses, collisions are exact,
  bending is resolved where it matters, and what should come to rest does. `auto` divides blocks into cells where they bend and nothing
  moves, and slender ones everywhere. Where blocks move squat ones stay polygons, as their ways are the same for a part of the time.
- **`block_model = "mesh"`** where stress or deflection is the answer. What a polygon cannot do no step and no tolerance
  mends. Errors of the arch and of the stresses in the slope depend on the model alone, and on the springs in `paper` and `classic`.
- **`block_model = "wachspress"`** where slender blocks move and only their ways are the answer. At rest it is the cheapest for blocks that
  lie on each other in order (arch). But polygons that bear each other at many corners (slope) take it several times the solutions of meshes.
  `affine` has no less to find and is stiffer: nothing here asks for it.
- **`scheme = "midpoint"`** for waves and vibrations that must live: its fronts are the sharpest. Not for what should come to rest.
- **`scheme = "explicit"`** for impacts and waves in steps that are short anyway: what is shorter than a step lives, at a few times the run time of
  the default. A single block that slides squeals by it (no damping here), and what slides or rests for long takes a hundred times the substeps.
- `dda` and `backward_euler` are of first order wherever blocks turn or collide; nothing here asks for them.
- **Steps**: rigid blocks that slide go as their forces have it in any step; where they turn halving it leaves a quarter of the error. Static steps should be long: they
  keep the blocks' masses over the square of their length, and short ones creep to the answer.
- **`contact.tolerance`** of 1e-3 changes none of these answers by more than its last digit: it is for scenes where many contacts change at once.
- **`penetration_tolerance`** stays as it is: 1e-4 saves next to nothing but in waves, up to a third there; 1e-8 changes next to nothing.
- **`preset = "paper"`, `classic`** to compare with, and for a cheap first look at what slides: a step costs less, forces and restitution
  depend on the springs and the step.
)";

/// What differs in the two charts of a picture.
const std::vector<std::vector<std::string>> panels{
    {"default", "classic", "paper", "explicit", "midpoint", "dda", "backward_euler"},
    {"default", "affine", "wachspress", "mesh", "tolerance 1e-4", "tolerance 1e-8", "contacts to 1e-3"}};

std::vector<Measurement> runs_of(const std::vector<Measurement>& all, const std::string& quantity,
                                 const std::string& method) {
  std::vector<Measurement> found;
  for (const Measurement& m : all)
    if (m.quantity == quantity && m.method == method) found.push_back(m);
  return found;
}

/// As a logarithmic axis can show it: 1 at most, and for runs that did not end; 1e-12 at least.
double shown(double error) {
  return std::isfinite(error) ? std::clamp(error, 1e-12, 1.) : 1.;
}

std::vector<Chart> charts_of(const std::vector<Measurement>& all, const std::string& quantity) {
  std::vector<Chart> charts;
  for (const auto& methods : panels) {
    Chart chart{.x_symbol = {"run time", "", ""},
                .y_symbol = {"error", "", ""},
                .x_unit = "s",
                .y_unit = "",
                .series = {},
                .x_logarithmic = true,
                .y_logarithmic = true};
    for (const std::string& method : methods) {
      Series series{.name = method, .x = {}, .y = {}, .dots = true};
      for (const Measurement& m : runs_of(all, quantity, method))
        if (m.seconds > 0) {
          series.x.push_back(m.seconds);
          series.y.push_back(shown(m.error));
        }
      if (!series.x.empty()) chart.series.push_back(series);
    }
    charts.push_back(chart);
  }
  return charts;
}

std::string cell(const Measurement& m) {
  if (!m.stopped.empty()) return m.seconds > 0 ? fmt::format("stopped, {:.2g} s", m.seconds) : "refused";
  return fmt::format("{} in {:.3g} ms", text(m.error), 1e3 * m.seconds);
}

std::vector<std::vector<std::string>> table_of(const std::vector<Measurement>& all, const Problem& problem,
                                               const std::string& quantity) {
  std::vector<std::vector<std::string>> rows{{problem.setting}};
  for (const double setting : problem.settings) rows[0].push_back(fmt::format("{:g}", setting));
  for (const Method& method : all_methods()) {
    const std::vector<Measurement> runs = runs_of(all, quantity, method.name);
    if (runs.empty()) continue;
    rows.push_back({method.name});
    for (const double setting : problem.settings) {
      const auto found = std::ranges::find_if(
          runs, [setting](const Measurement& m) { return std::abs(m.setting / setting - 1) < 1e-4; });
      rows.back().push_back(found == runs.end() ? "" : cell(*found));
    }
  }
  return rows;
}

std::string ahead(const std::string& quantity, const std::vector<Measurement>& all,
                  const std::string& other) {
  const auto lead = lead_of(frontier(all, quantity, "default"), frontier(all, quantity, other));
  if (!lead) return "no run";
  const auto factor = [&](double ratio, double at) {
    return ratio >= 1
               ? fmt::format("{:.3g} × more accurate than {} at {:.2g} ms", ratio, other, 1e3 * at)
               : fmt::format("{:.3g} × less accurate than {} at {:.2g} ms", 1 / ratio, other, 1e3 * at);
  };
  return fmt::format("{} to {}", factor(lead->least, lead->least_at), factor(lead->most, lead->most_at));
}

bool never_behind(const std::string& quantity, const std::vector<Measurement>& all,
                  const std::string& other) {
  const auto lead = lead_of(frontier(all, quantity, "default"), frontier(all, quantity, other));
  return lead && lead->least >= 1;
}

}  // namespace

void write_page(const std::filesystem::path& directory, const std::vector<Measurement>& all) {
  verification::Report report(directory, "requirement");
  std::vector<std::vector<std::string>> methods{{"method", "what it is"}};
  for (const Method& method : all_methods()) methods.push_back({method.name, method.description});
  report.table(methods);
  report.paragraph(
      "Methods below the first three are the default with that one thing changed. Contact springs are 40 E. "
      "At equal "
      "run time: each method's best run that takes no longer, interpolated between runs by logarithms. "
      "Errors above 1 "
      "and runs that stop are drawn at 1.");
  std::vector<verification::Claim> claims;
  for (const Problem& problem : all_problems()) {
    report.heading(problem.title);
    report.paragraph(problem.description);
    for (const auto& [name, called] : problem.quantities) {
      if (runs_of(all, name, "default").empty()) {
        report.paragraph("Not in this table of measurements.");
        continue;
      }
      report.picture("dda_accuracy_" + name,
                     draw(charts_of(all, name), {.title = problem.title, .width = 760, .plot_height = 250}),
                     fmt::format("The {} over run time, s.", called));
      report.table(table_of(all, problem, name));
      report.paragraph(fmt::format("At equal run time the default is {}. It is {}.",
                                   ahead(name, all, "classic"), ahead(name, all, "paper")));
      claims.push_back({fmt::format("{}: {}", problem.title, called), never_behind(name, all, "classic"),
                        "default " + ahead(name, all, "classic")});
    }
  }
  report.heading("The default against `classic` at equal run time");
  report.paragraph("Asked: the default is at least as accurate at every run time at which both have runs.");
  report.claims(claims);
  report.paragraph(why_behind);
  report.heading("What to choose when");
  report.paragraph(what_to_choose);
  report.write("dda_accuracy", front);
}

}  // namespace error_time
