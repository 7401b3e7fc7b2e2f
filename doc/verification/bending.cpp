#include "blocks_chapters.hpp"
#include "stress_fields.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/chart.hpp>
#include <ddacontact/picture/picture.hpp>

#include <algorithm>
#include <cmath>

namespace verification {

namespace {

/// The beam: 0 <= x <= length, |y| <= 1/2, so that its second moment of area is 1/12 m4 per m.
constexpr double length = 4, young = 1e9, second_moment = 1. / 12;

Points beam() {
  return rectangle(0, -0.5, length, 1);
}

/// Loads a free beam at both ends with a stress field that leaves its long sides free.
BuiltScene run_beam(const BlockDescription& description, double poisson, const StressField& exact) {
  Scene scene = static_scene(description, poisson);
  const auto traction = [&](double outwards) {
    return [&exact, outwards](const Vec2& x) -> Vec2 {
      const Vec3 s = exact(x);
      return outwards * Vec2(s[0], s[2]);
    };
  };
  add_traction(scene, {length, -0.5}, {length, 0.5}, traction(1));
  add_traction(scene, {0, -0.5}, {0, 0.5}, traction(-1));
  return run(scene);
}

constexpr double moment = 1e3, shear_force = 1e3;
Vec3 bent(const Vec2& x) {
  return {moment / second_moment * x.y(), 0, 0};
}
Vec3 sheared(const Vec2& x) {
  return {shear_force / second_moment * x.x() * x.y(), 0,
          shear_force / (2 * second_moment) * (0.25 - x.y() * x.y())};
}

/// Elastic energy over that of the beam, M² L / (2 E' I): how far it bends, relative.
double compliance(const BlockDescription& description, double poisson) {
  const double plane_young = young / (1 - poisson * poisson);
  return run_beam(description, poisson, bent).stepper->energy().now.elastic /
         (moment * moment * length / (2 * plane_young * second_moment));
}

std::string percent(double part) {
  return fmt::format("{:.2f} %", 100 * part);
}

}  // namespace

void bending(Report& report) {
  report.heading("1. Bending");
  report.paragraph(
      "A free block of 4 x 1 m, ν = 0.3, with moments at its ends as linear tractions, static. The beam "
      "bends to "
      "the elastic energy M²L/2E'I, E' = E/(1 − ν²), which is exact here. Energy over that, by cells asked "
      "for; "
      "`mesh` divides a rectangle into squares by default (`quads`).");
  BlockDescription single = block(beam());
  single.model = BlockModel::wachspress;
  const double one_polygon = compliance(single, 0.3);
  std::vector<std::vector<std::string>> rows{
      {"cells", "quads", "voronoi", "quads, ν = 0.4999", "voronoi, ν = 0.4999", "quads, straight edges"}};
  std::vector<double> by_default, by_voronoi, incompressible;
  for (const int cells : {16, 64, 256, 1024}) {
    by_default.push_back(compliance(meshed(beam(), CellKind::by_shape, cells), 0.3));
    by_voronoi.push_back(compliance(meshed(beam(), CellKind::voronoi, cells), 0.3));
    rows.push_back({fmt::format("{}", cells), percent(by_default.back()), percent(by_voronoi.back())});
    for (const CellKind kind : {CellKind::by_shape, CellKind::voronoi}) {
      const double ratio = cells > 256 ? 0 : compliance(meshed(beam(), kind, cells), 0.4999);
      if (cells == 64) incompressible.push_back(ratio);
      rows.back().push_back(cells > 256 ? "" : percent(ratio));
    }
    rows.back().push_back(
        cells > 256 ? "" : percent(compliance(meshed(beam(), CellKind::by_shape, cells, false), 0.3)));
  }
  report.table(rows);
  report.paragraph(fmt::format(
      "The block as a single Wachspress polygon: {}. With `edge_nodes = false` the long sides stay straight, "
      "whatever the cells inside: that is for blocks that are not bent. Above ν = 0.45 cells have their mean "
      "dilatation (B-bar), else they would lock.",
      percent(one_polygon)));
  const BuiltScene coarse = run_beam(single, 0.3, bent),
                   chosen = run_beam(meshed(beam(), CellKind::by_shape, 64), 0.3, bent),
                   fine = run_beam(meshed(beam(), CellKind::by_shape, 256), 0.3, bent);
  const Frame frames[] = {frame_of(coarse), frame_of(chosen), frame_of(fine)};
  report.picture(
      "blocks_bending",
      draw({{.frame = &frames[0], .field = Field::sxx, .caption = "one Wachspress polygon"},
            {.frame = &frames[1], .field = Field::sxx, .caption = "64 cells"},
            {.frame = &frames[2], .field = Field::sxx, .caption = "256 cells"}},
           {.title = "Bending: the beam has ±6 kPa at its long sides", .width = 900, .columns = 2}),
      "σxx of a bent block as one polygon, with 64 cells and with 256.");
  report.claims(
      {{"A single Wachspress polygon has 14.7 % of the beam's compliance.",
        std::abs(one_polygon - 0.147) <= 0.001, percent(one_polygon)},
       {"Within 4 % of the beam with 64 cells.", std::abs(by_default[1] - 1) <= 0.04,
        percent(std::abs(by_default[1] - 1)) + " off"},
       {"Within 1 % with 256.", std::abs(by_default[2] - 1) <= 0.01,
        percent(std::abs(by_default[2] - 1)) + " off"},
       {"Voronoi cells: within 5 % with 64, 1.5 % with 256.",
        std::abs(by_voronoi[1] - 1) <= 0.05 && std::abs(by_voronoi[2] - 1) <= 0.015,
        percent(std::abs(by_voronoi[1] - 1)) + " and " + percent(std::abs(by_voronoi[2] - 1)) + " off"},
       {"Next to incompressible (ν = 0.4999): within 4 % with 64 cells of either kind.",
        std::abs(incompressible[0] - 1) <= 0.04 && std::abs(incompressible[1] - 1) <= 0.04,
        percent(std::abs(incompressible[0] - 1)) + " and " + percent(std::abs(incompressible[1] - 1)) +
            " off"}});
}

void stress_inside(Report& report) {
  report.heading("2. Stress inside a block");
  report.paragraph(
      "The same block, bent (σxx = M y/I), and as a cantilever with a shear force Q at its ends: σxx = Q x "
      "y/I, σxy = Q (h²/4 − y²)/2I. These are the exact stresses under the tractions that go with them at "
      "the ends. Error of the stress in the energy norm, integrated over all cells. Cells carry stresses "
      "that are constant and a little more, so that the rate to expect is 1 in the size of the cells.");
  std::vector<std::vector<std::string>> rows{{"case", "cells", "asked", "made", "error", "rate"}};
  Chart chart{.x_symbol = {"cells across", "", ""},
              .y_symbol = {"error of stress", "", ""},
              .x_unit = "",
              .y_unit = "",
              .series = {},
              .x_logarithmic = true,
              .y_logarithmic = true};
  double least_rate = 1e300;
  struct Case {
    const char* name;
    Vec3 (*exact)(const Vec2&);
  };
  for (const auto& [name, exact] : {Case{"bent", bent}, Case{"cantilever", sheared}})
    for (const CellKind kind : {CellKind::quads, CellKind::voronoi}) {
      const char* kind_name = kind == CellKind::quads ? "quads" : "voronoi";
      Series series{fmt::format("{}, {}", name, kind_name), {}, {}};
      series.dots = true;
      double first = 0, last = 0;
      int first_cells = 0, last_cells = 0;
      for (const int cells : {16, 64, 256, 1024}) {
        const BuiltScene built = run_beam(meshed(beam(), kind, cells), 0.3, exact);
        const double error = stress_error(frame_of(built), 0, exact);
        const int made = n_cells(built);
        std::string rate;
        if (last > 0)
          rate = fmt::format("{:.2f}", 2 * std::log(last / error) / std::log(double(made) / last_cells));
        if (last == 0) first = error, first_cells = made;
        last = error;
        last_cells = made;
        rows.push_back(
            {name, kind_name, fmt::format("{}", cells), fmt::format("{}", made), text(error), rate});
        series.x.push_back(std::sqrt(made / length));
        series.y.push_back(error);
      }
      least_rate =
          std::min(least_rate, 2 * std::log(first / last) / std::log(double(last_cells) / first_cells));
      chart.series.push_back(series);
    }
  report.table(rows);
  report.picture("blocks_stress_rate", draw({chart}, {.title = "Stress inside a block", .plot_height = 260}),
                 "Error of the stress in the energy norm against the number of cells across the block.");
  const BuiltScene coarse = run_beam(meshed(beam(), CellKind::voronoi, 64), 0.3, sheared),
                   fine = run_beam(meshed(beam(), CellKind::quads, 256), 0.3, sheared);
  const Frame frames[] = {frame_of(coarse), frame_of(fine)};
  std::vector<Panel> panels;
  for (const Field field : {Field::sxx, Field::sxy})
    for (int k = 0; k < 2; ++k)
      panels.push_back(
          {.frame = &frames[k], .field = field, .caption = k == 0 ? "64 Voronoi cells" : "256 squares"});
  report.picture(
      "blocks_stress",
      draw(panels, {.title = "Cantilever", .width = 900, .columns = 2, .sharing = RangeSharing::rows}),
      "σxx and σxy of the cantilever, 64 Voronoi cells beside 256 squares.");
  report.claims(
      {{"The error falls with the size of the cells at rate 1 (0.9 or more from 16 to 1024 cells), "
        "bent and sheared, quads and Voronoi cells.",
        least_rate >= 0.9, fmt::format("{:.2f} at least", least_rate)}});
}

}  // namespace verification
