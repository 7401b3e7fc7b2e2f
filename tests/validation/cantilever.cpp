/// \file A cantilever of one block, and one of bonded blocks.
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/chart.hpp>
#include <ddacontact/picture/picture.hpp>
#include <mechanics_scenes.hpp>

#include <algorithm>
#include <cmath>

namespace validation {

namespace {

using namespace verification;

/// Clamped at x = 0, under its own weight.
struct Beam {
  double length = 8, height = 1;  // m
  Plane plane = Plane::strain;
  double poisson = 0.3;
};
constexpr double young = 35e9, density = 2500;  // Pa, kg/m3

/// Of the middle of the end by bending and by shear (Timoshenko, 5/6), m.
double tip_deflection(const Beam& beam) {
  const double h = beam.height, L = beam.length, q = density * gravity * h;
  const double E = beam.plane == Plane::strain ? young / (1 - beam.poisson * beam.poisson) : young;
  const double G = young / (2 * (1 + beam.poisson));
  return q * std::pow(L, 4) / (8 * E * h * h * h / 12) + q * L * L / (2 * 5. / 6 * G * h);
}

Scene static_scene(const Beam& beam) {
  Scene scene = rock_scene(1, 4, young);
  scene.analysis.mode = Mode::statics;
  scene.analysis.plane = beam.plane;
  scene.materials = {{"rock", density, young, beam.poisson}};
  scene.joints[0] = {"mortar", 45, 1e12, 1e12, std::nullopt};
  return scene;
}

BlockDescription meshed(const Points& outline, CellKind kind, int cells) {
  BlockDescription of = block(outline);
  of.model = BlockModel::mesh;
  of.mesh.kind = kind;
  of.mesh.cells = cells;
  return of;
}

struct Bent {
  double deflection = 0;  ///< of the middle of the end, m
  int unknowns = 0;
  double seconds = 0;
  BuiltScene built;
};

Bent bend(Scene scene, const Beam& beam, int tip_block) {
  Monitor tip;
  tip.name = "tip";
  tip.kind = Monitor::Kind::point;
  tip.block = tip_block;
  tip.at = {beam.length, beam.height / 2};
  scene.monitors = {tip};
  Bent bent;
  bent.seconds = seconds_of([&] { bent.built = run(scene); });
  bent.unknowns = bent.built.stepper->blocks().n_unknowns();
  bent.deflection = -observe(bent.built.monitor_targets[0], *bent.built.stepper).displacement.y();
  return bent;
}

Bent bend_block(const Beam& beam, BlockDescription of) {
  Scene scene = static_scene(beam);
  of.fixed_vertices = {0, 3};
  scene.blocks = {of};
  return bend(scene, beam, 0);
}

enum class Bond { stacked, running };

/// `courses` of bricks 2 : 1, each of `cells` cells (1: Wachspress; 0: as "auto" has it).
/// \param[in] springs  > 0: by the original method, with these times E
Bent bend_wall(const Beam& beam, Bond bond, int courses, int cells, double springs = 0,
               double tolerance = 1e-6) {
  Scene scene = static_scene(beam);
  scene.contact.penetration_tolerance = tolerance;
  if (springs > 0) scene.contact = {ContactMethod::classic, springs * young, springs * young / 2.5, 0};
  const double h = beam.height / courses, w = 2 * h;
  int tip = 0;
  for (int row = 0; row < courses; ++row) {
    double x = 0, next = bond == Bond::running && row % 2 == 1 ? w / 2 : w;
    while (x < beam.length - 1e-9) {
      next = std::min(next, beam.length);
      BlockDescription brick = cells <= 1
                                   ? block(rectangle(x, row * h, next - x, h))
                                   : meshed(rectangle(x, row * h, next - x, h), CellKind::quads, cells);
      if (cells == 0) brick.model = BlockModel::automatic;
      if (x == 0) brick.fixed_vertices = {0, 3};
      scene.blocks.push_back(brick);
      x = next;
      next += w;
    }
    if (row == courses / 2) tip = static_cast<int>(scene.blocks.size()) - 1;
  }
  return bend(scene, beam, tip);
}

std::string percent(double part) {
  return fmt::format("{:.2f} %", 100 * part);
}

void one_block(Report& report) {
  report.paragraph(
      "### One block\n\nTip deflection over the beam's, by cells asked for. With ν = 0 the clamp restrains "
      "nothing that the beam does not know of. With ν = 0.3 it also keeps the end from changing its height, "
      "which stiffens the last half height or so.");
  const std::vector<int> cells{64, 256, 1024, 4096};
  std::vector<std::vector<std::string>> rows{{"beam", "cells"}};
  for (const int n : cells) rows[0].push_back(fmt::format("{}", n));
  rows[0].insert(rows[0].end(), {"one polygon", "s, 4096 cells"});
  struct Case {
    const char* name;
    Beam beam;
  };
  double plain = 0, restrained = 0, rate = 1e300;
  for (const auto& [name, beam] :
       {Case{"10 x 1 m, ν = 0", {.length = 10, .poisson = 0}},
        Case{"5 x 1 m, ν = 0, plane stress", {.length = 5, .plane = Plane::stress, .poisson = 0}},
        Case{"8 x 1 m, ν = 0.3", {}}, Case{"6 x 1.5 m, ν = 0.2, plane stress", {6, 1.5, Plane::stress, 0.2}}})
    for (const CellKind kind : {CellKind::quads, CellKind::voronoi}) {
      const Points outline = rectangle(0, 0, beam.length, beam.height);
      rows.push_back({name, kind == CellKind::quads ? "quads" : "voronoi"});
      std::vector<double> errors;
      double seconds = 0;
      for (const int n : cells) {
        const Bent bent = bend_block(beam, meshed(outline, kind, n));
        const double ratio = bent.deflection / tip_deflection(beam);
        rows.back().push_back(percent(ratio));
        errors.push_back(std::abs(ratio - 1));
        seconds = bent.seconds;
      }
      rows.back().push_back(percent(bend_block(beam, block(outline)).deflection / tip_deflection(beam)));
      rows.back().push_back(fmt::format("{:.2f}", seconds));
      (beam.poisson == 0 ? plain : restrained) =
          std::max(beam.poisson == 0 ? plain : restrained, errors.back());
      if (beam.poisson == 0) rate = std::min(rate, std::log2(errors[1] / errors[3]) / 2);
    }
  report.table(rows);
  report.claims(
      {{"ν = 0: the beam's deflection to 0.3 % with 4096 cells.", plain <= 0.003, percent(plain) + " off"},
       {"It is reached at rate 2 in the size of the cells (1.6 or more from 256 to 4096).", rate >= 1.6,
        fmt::format("{:.2f} at least", rate)},
       {"ν = 0.2 and 0.3: to 1.5 %, the restraint of the clamp included.", restrained <= 0.015,
        percent(restrained) + " off"}});
}

void wall(Report& report) {
  const Beam beam;
  report.paragraph(
      "### A wall of bonded bricks\n\nThe beam of 8 x 1 m, ν = 0.3, is a wall of bricks 2 : 1 in courses, "
      "clamped at its left end. Mortar that does not break holds it (cohesion and tensile strength). The "
      "joints are one above the other, or in running bond, each upper joint over the middle of a brick. Tip "
      "deflection over the beam's:");
  struct Case {
    const char* name;
    Bond bond;
    int cells;
  };
  const std::vector<int> courses{1, 2, 4, 8};
  std::vector<std::vector<std::string>> rows{{"courses", "bricks, about"}};
  for (const int n : courses) rows.push_back({fmt::format("{}", n), fmt::format("{}", 4 * n * n)});
  Chart chart{.x_symbol = {"courses", "", ""},
              .y_symbol = {"deflection over the beam's", "", ""},
              .x_unit = "",
              .y_unit = "",
              .series = {},
              .x_logarithmic = true};
  chart.series.push_back({"beam", {1, 8}, {1, 1}, false, false, true});
  std::vector<double> last;
  long broken = 0;
  for (const auto& [name, bond, cells] :
       {Case{"one above the other, polygons", Bond::stacked, 1},
        Case{"one above the other, 8 cells each", Bond::stacked, 8},
        Case{"running bond, polygons", Bond::running, 1},
        Case{"running bond, 8 cells each", Bond::running, 8}, Case{"running bond, auto", Bond::running, 0}}) {
    rows[0].push_back(name);
    Series series{name, {}, {}};
    series.dots = true;
    for (std::size_t k = 0; k < courses.size(); ++k) {
      if (cells != 1 && courses[k] > 4) {
        rows[k + 1].push_back("");
        continue;
      }
      const Bent bent = bend_wall(beam, bond, courses[k], cells);
      const double ratio = bent.deflection / tip_deflection(beam);
      broken += bent.built.stepper->counts().broken_bonds;
      rows[k + 1].push_back(percent(ratio));
      series.x.push_back(courses[k]);
      series.y.push_back(ratio);
    }
    last.push_back(series.y.back());
    chart.series.push_back(series);
  }
  report.table(rows);
  report.paragraph(
      "Bonded corner to corner, polygons are the elements of a conforming mesh: too stiff while they are "
      "few, and right as they are many. What is missing is not stiffness of the joints but the bending of "
      "the bricks. In running bond it does not come. A corner bonded to the middle of an edge must stay on "
      "the straight line between the ends of that edge, in every course. So no brick can bend or shear as "
      "its neighbours do, however small the bricks are. Bricks of cells, whose edges bend and whose cells' "
      "corners are bonded too, do not have that. `auto` divides bricks where they are slender or their "
      "bending counts.");
  std::vector<std::vector<std::string>> springs{{"bond, four courses of polygons", "p = E", "10 E", "40 E",
                                                 "1000 E", "default, penetration to 1e-6", "to 1e-7",
                                                 "to 1e-8"}};
  for (const Bond bond : {Bond::stacked, Bond::running}) {
    springs.push_back({bond == Bond::stacked ? "one above the other" : "running bond"});
    for (const double p : {1., 10., 40., 1000.})
      springs.back().push_back(percent(bend_wall(beam, bond, 4, 1, p).deflection / tip_deflection(beam)));
    for (const double tolerance : {1e-6, 1e-7, 1e-8}) {
      std::string seen = "stopped";
      try {
        seen = percent(bend_wall(beam, bond, 4, 1, 0, tolerance).deflection / tip_deflection(beam));
      } catch (const Error&) {  // not that tight
      }
      springs.back().push_back(seen);
    }
  }
  report.paragraph(
      "The springs of `classic` are joints that give: the softer, the larger the deflection, which can look "
      "like the right answer. "
      "The default's joints are rigid up to its penetration_tolerance, 1e-6 of the size of a brick. That "
      "does not show where the "
      "wall can bend; where its bonds lock it, the tolerance is what gives, and at 1e-8 no forces are found "
      "that hold them all.");
  report.table(springs);
  report.picture(
      "dda_cantilever_walls",
      draw({chart}, {.title = "A cantilevered wall of bonded bricks", .width = 760, .plot_height = 260}),
      "Tip deflection over the beam's against the number of courses.");
  const Bent polygons = bend_wall(beam, Bond::running, 4, 1), cells = bend_wall(beam, Bond::running, 4, 8);
  const auto frame_of = [](const Bent& bent) {
    return capture_frame(*bent.built.stepper, bent.built.labels, {});
  };
  const Frame frames[] = {frame_of(polygons), frame_of(cells)};
  report.picture("dda_cantilever_stress",
                 draw({{.frame = &frames[0], .field = Field::sxx, .caption = "polygons"},
                       {.frame = &frames[1], .field = Field::sxx, .caption = "8 cells each"}},
                      {.title = "A wall in running bond, under its weight", .width = 900, .columns = 1}),
                 "σxx in a wall in running bond: bricks of one polygon, and of 8 cells.");
  report.claims({{"Joints one above the other, polygons: within 5 % of the beam with 8 courses.",
                  std::abs(last[0] - 1) <= 0.05, percent(last[0])},
                 {"Bricks of 8 cells, either bond: within 3 % with 4 courses.",
                  std::abs(last[1] - 1) <= 0.03 && std::abs(last[3] - 1) <= 0.03,
                  fmt::format("{} and {}", percent(last[1]), percent(last[3]))},
                 {"Running bond, polygons: within 5 % with 8 courses.", std::abs(last[2] - 1) <= 0.05,
                  percent(last[2]) + ": straight edges do not let it bend"},
                 {"No bond breaks.", broken == 0, fmt::format("{} broken", broken)}});
}

}  // namespace

void cantilever(Report& report) {
  report.heading("Cantilevers");
  report.paragraph(
      "A cantilever under its own weight q = ρ g h, clamped at one end, static, E = 35 GPa. Its deflection "
      "is w = q L⁴/8E'I + q L²/2κG h, κ = 5/6, E' = E/(1 − ν²) in plane strain (Timoshenko).");
  one_block(report);
  wall(report);
}

}  // namespace validation
