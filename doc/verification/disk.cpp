#include "blocks_chapters.hpp"
#include "stress_fields.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/picture.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>

namespace verification {

namespace {

constexpr int n_corners = 40;
constexpr double radius = 1, force = 1e4;

/// Regular, with corners at the lowest and the highest point.
Points polygon() {
  Points corners(2, n_corners);
  for (int k = 0; k < n_corners; ++k)
    corners.col(k) = radius * Vec2(-std::sin(turn * k / n_corners), std::cos(turn * k / n_corners));
  return corners;
}

/// Of the circle of the polygon's area.
double diameter() {
  return std::sqrt(8 * polyfem::signed_area(polygon()) / turn);
}

/// Hertz: two forces P towards each other at the ends of the vertical diameter, and what makes the rim free.
Vec3 hertz(const Vec2& x, double P) {
  const double R = diameter() / 2, a = R - x.y(), b = R + x.y();
  const double r1 = std::pow(x.x() * x.x() + a * a, 2), r2 = std::pow(x.x() * x.x() + b * b, 2);
  const double scale = -4 * P / turn;
  return scale * Vec3(x.x() * x.x() * a / r1 + x.x() * x.x() * b / r2 - 1 / (2 * R),
                      a * a * a / r1 + b * b * b / r2 - 1 / (2 * R),
                      -x.x() * a * a / r1 + x.x() * b * b / r2);
}

struct Squeezed {
  BuiltScene built;
  int disk;
  double force;  ///< that squeezes it
};

Squeezed by_point_loads(const BlockDescription& description) {
  Scene scene = static_scene(description, 0.3);
  for (const double side : {-1., 1.}) {
    Load load;
    load.at = {0, side * radius};
    load.force.value = {0, -side * force};
    scene.loads.push_back(load);
  }
  return {run(scene), 0, force};
}

/// Between two rough plates, the lower held, the upper lowered.
Squeezed by_plates(const BlockDescription& description) {
  Scene scene = static_scene(description, 0.3);
  scene.joints[0].friction_angle = 30;
  scene.blocks.push_back(block(rectangle(-1, -radius - 0.5, 2, 0.5), true));
  scene.blocks.push_back(block(rectangle(-1, radius, 2, 0.5)));
  Support lowered;
  lowered.block = 2;
  lowered.vertices = {0, 1, 2, 3};
  lowered.displacement = {TimeFunction::Kind::ramp, Vec2(0, -4e-5), {}};
  scene.supports = {lowered};
  Squeezed squeezed{run(scene), 0, 0};
  const Stepper& stepper = *squeezed.built.stepper;
  squeezed.force = normal_force_between(stepper, 0, 2);
  return squeezed;
}

}  // namespace

void disk(Report& report) {
  report.heading("3. A disk under two opposite forces");
  report.paragraph(fmt::format(
      "A regular {}-gon of circumradius {:g} m, ν = 0.3, static, no gravity, is squeezed along the vertical "
      "in two ways. It is loaded by two forces of {:g} kN/m at opposite corners. It is squeezed between two "
      "rigid plates, the lower fixed and the upper lowered by 40 µm, through contacts whose force is the P "
      "of the closed form. Hertz: σxx = 2P/πD, σyy = −6P/πD at the centre of a disk of diameter D. Here D = "
      "{:.5f} m, that of the circle of the same area (the circle through the corners is 0.2 % larger, the "
      "one inside 0.1 % smaller). Centre stress: the area mean within D/40 of the centre. Error over the "
      "inner half: energy norm over the disk of half the diameter, against Hertz's field.",
      n_corners, radius, force / 1e3, diameter()));
  std::vector<std::vector<std::string>> rows{{"squeezed by", "cells", "P, kN/m", "σxx πD/2P", "σyy πD/2P",
                                              "error of σxx", "error of σyy", "error over the inner half"}};
  double worst[2] = {0, 0};
  std::vector<Frame> frames;
  std::vector<std::string> captions;
  for (const bool plates : {false, true})
    for (const int cells : {64, 250, 1000, 4000}) {
      const BlockDescription description = meshed(polygon(), CellKind::by_shape, cells);
      const Squeezed squeezed = plates ? by_plates(description) : by_point_loads(description);
      const Frame frame = frame_of(squeezed.built);
      const Vec3 centre = mean_stress_near(frame, squeezed.disk, {0, 0}, diameter() / 40) * turn / 4 *
                          diameter() / squeezed.force;
      const double inner = stress_error(
          frame, squeezed.disk, [&](const Vec2& x) { return hertz(x, squeezed.force); },
          [](const Vec2& x) { return x.norm() <= diameter() / 4; });
      const double off_x = std::abs(centre[0] - 1), off_y = std::abs(centre[1] / -3 - 1);
      if (cells >= 250) worst[plates] = std::max({worst[plates], off_x, off_y});
      rows.push_back({plates ? "plates" : "forces", fmt::format("{}", n_cells(squeezed.built)),
                      fmt::format("{:.3f}", squeezed.force / 1e3), fmt::format("{:.4f}", centre[0]),
                      fmt::format("{:.4f}", centre[1]), text(off_x), text(off_y), text(inner)});
      if (!plates && (cells == 64 || cells == 1000)) {
        frames.push_back(frame);
        captions.push_back(rows.back()[1] + " cells");
      }
    }
  report.table(rows);
  std::vector<Panel> panels;
  for (std::size_t k = 0; k < frames.size(); ++k)
    panels.push_back({.frame = &frames[k], .field = Field::sxx, .caption = captions[k]});
  report.picture("blocks_disk",
                 draw(panels, {.title = "A disk squeezed by 10 kN/m",
                               .width = 800,
                               .columns = 2,
                               .range = ValueRange{-8e3, 8e3}}),
                 "σxx with 64 cells and with 1000; colours end at ±8 kPa. Hertz has 3.2 kPa at the centre.");
  report.claims({{"Two forces: the centre stress within 1 % of the closed form from 250 cells on.",
                  worst[0] <= 0.01, text(worst[0])},
                 {"Between plates, through contacts: the same.", worst[1] <= 0.01, text(worst[1])}});
}

}  // namespace verification
