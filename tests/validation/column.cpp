/// \file A column under its weight.
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/field.hpp>
#include <ddacontact/picture/picture.hpp>
#include <mechanics_scenes.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace validation {

namespace {

using namespace verification;

struct Column {
  const char* name;
  double height, width;  ///< m
  Material material;
  double weight_stress() const { return material.density * gravity * height; }
  /// Pa, under stress along the column with free sides, in plane strain.
  double modulus() const { return material.young / (1 - material.poisson * material.poisson); }
  double shortening() const { return weight_stress() * height / (2 * modulus()); }
};
constexpr int cells = 100, settling_steps = 300;

/// One above the other on a floor without friction.
struct Blocks {
  int number = 1;
  BlockModel model = BlockModel::wachspress;
  const char* caption = "";  ///< of those in the picture
};

Scene column_scene(const Column& column, const Blocks& blocks) {
  Scene scene = rock_scene(0.01, settling_steps, column.material.young);
  scene.materials = {column.material};
  scene.contact.penetration_tolerance = 1e-9;  // a thousandth of it closed contacts may keep as a gap
  scene.blocks = {block(rectangle(-2 * column.width, -column.width, 4 * column.width, column.width), true)};
  for (int k = 0; k < blocks.number; ++k) {
    const double height = column.height / blocks.number;
    scene.blocks.push_back(block(rectangle(-column.width / 2, k * height, column.width, height)));
    scene.blocks.back().model = blocks.model;
    scene.blocks.back().mesh.cells = cells;
  }
  return scene;
}

/// How far the top has sunk on average over its width, m.
double shortening(const Frame& frame, const Column& column) {
  const Range& top = frame.blocks.back();
  std::map<double, double> sunk;  // over x
  for (int k = top.first; k < top.first + top.count; ++k)
    if (frame.position(1, k) > 0.99 * column.height) sunk[frame.position(0, k)] = -frame.displacement(1, k);
  double sum = 0;
  for (auto from = sunk.begin(), to = std::next(from); to != sunk.end(); ++from, ++to)
    sum += (to->first - from->first) * (from->second + to->second) / 2;
  return sum / (sunk.rbegin()->first - sunk.begin()->first);
}

double exact_stress(const Column& column, double y) {
  return -column.material.density * gravity * (column.height - y);
}

/// Of the blocks' means, over the stress at the bottom.
double error_of_means(const Frame& frame, const Column& column) {
  double worst = 0;
  for (int b = 1; b < frame.n_blocks(); ++b) {
    const double middle = (b - 0.5) * column.height / (frame.n_blocks() - 1);
    worst = std::max(worst, std::abs(frame.mean_stress(1, b) - exact_stress(column, middle)));
  }
  return worst / column.weight_stress();
}

/// In the middles of the cells, the same; those within a width of the floor not counted.
double error_inside(const Frame& frame, const Column& column) {
  double worst = 0;
  for (int c = 0; c < frame.n_cells(); ++c) {
    if (frame.cells[c].block == 0) continue;
    CellField stress(frame, c, Field::syy);
    const Vec2 middle = polyfem::area_moments(stress.corners()).centroid;
    const double y = middle.y() + frame.position(1, frame.corners(c)[0]);
    if (y > column.width) worst = std::max(worst, std::abs(stress(middle) - exact_stress(column, y)));
  }
  return worst / column.weight_stress();
}

}  // namespace

void column(Report& report) {
  const Column columns[] = {{"rock", 10, 2, {"rock", 2500, 35e9, 0.3}},
                            {"clay", 6, 1, {"clay", 1900, 600e6, 0.45}}};
  report.heading("A column under its weight");
  report.paragraph(
      "A column of height H on a floor without friction is one block of 100 cells or 1 to 20 blocks of four "
      "corners upon each other. These have springs between them, Wachspress's or the affine functions. It "
      "settles in 300 steps of 0.01 s under sudden gravity, with a tolerance of penetration of 1e-9. With "
      "the default of 1e-6 closed contacts keep gaps that are 6e-4 of the settlement. In plane strain with "
      "free sides σyy = −ρ g (H − y), and the top sinks on average by ρ g H²/(2 E'), E' = E/(1 − ν²). The "
      "latter is exact on a flat floor too, by reciprocity with the uniformly pressed column.");
  std::vector<std::vector<std::string>> rows{{"column", "blocks", "sinking, m", "exact", "error",
                                              "error of the blocks' mean σyy, of ρ g H",
                                              "of σyy in the cells", "floor's force / weight − 1"}};
  double sinking = 0, means = 0, floor = 0, inside = 0;
  std::vector<Frame> frames;
  std::vector<std::string> captions;
  for (const Column& column : columns)
    for (const Blocks& blocks : {Blocks{1, BlockModel::wachspress, "1 block"},
                                 {2},
                                 {5, BlockModel::wachspress, "5 blocks"},
                                 {5, BlockModel::affine},
                                 {10},
                                 {20, BlockModel::wachspress, "20 blocks"},
                                 {1, BlockModel::mesh, "cells"}}) {
      const BuiltScene built = run(column_scene(column, blocks));
      const Frame frame = capture_frame(*built.stepper, built.labels, {});
      const bool meshed = blocks.model == BlockModel::mesh;
      const double sunk = shortening(frame, column), error = sunk / column.shortening() - 1;
      const double of_means = error_of_means(frame, column),
                   of_cells = meshed ? error_inside(frame, column) : 0;
      const double of_floor =
          normal_force_between(*built.stepper, 0, 1) / (column.weight_stress() * column.width) - 1;
      sinking = std::max(sinking, std::abs(error));
      means = std::max(means, of_means);
      floor = std::max(floor, std::abs(of_floor));
      inside = std::max(inside, of_cells);
      rows.push_back(
          {column.name,
           meshed ? fmt::format("1 of {} cells", cells)
                  : fmt::format("{}{}", blocks.number, blocks.model == BlockModel::affine ? ", affine" : ""),
           fmt::format("{:.6e}", sunk), fmt::format("{:.6e}", column.shortening()), text(error),
           text(of_means), meshed ? text(of_cells) : "", text(of_floor)});
      if (&column == &columns[0] && *blocks.caption) {
        frames.push_back(frame);
        captions.push_back(blocks.caption);
      }
    }
  report.table(rows);
  std::vector<Panel> panels;
  for (std::size_t k = 0; k < frames.size(); ++k)
    panels.push_back({.frame = &frames[k], .field = Field::syy, .caption = captions[k]});
  report.picture("dda_column", draw(panels, {.title = "A column of rock", .columns = 4}),
                 "σyy of a column of rock of 1, 5 and 20 blocks, each with its mean stress along the column, "
                 "and of 100 cells.");
  report.claims(
      {{"The top sinks by ρ g H²/(2 E') to 1e-6, whatever the number of blocks or cells.", sinking < 1e-6,
        text(sinking)},
       {"Every block's mean σyy is that of its middle, to 1e-6 of ρ g H.", means < 1e-6, text(means)},
       {"The floor carries the weight to 1e-8.", floor < 1e-8, text(floor)},
       {"In the cells σyy is −ρ g (H − y) to 1 % of ρ g H, a width above the floor and higher.",
        inside < 0.01, text(inside)}});
}

}  // namespace validation
