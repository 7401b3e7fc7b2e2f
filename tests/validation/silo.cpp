/// \file Janssen's silo.
#include "chapters.hpp"

#include <fmt/format.h>
#include <ddacontact/output/frame.hpp>
#include <ddacontact/picture/chart.hpp>
#include <mechanics_scenes.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace validation {

namespace {

using namespace verification;

constexpr double density = 2500;                     // kg/m3
constexpr double time_step = 0.01;                   // s
constexpr int settling_steps = 60, all_steps = 200;  // before the floor sinks, and with it
constexpr double sinking = 0.01;                     // m, of the floor
enum Part { floor_block, left_wall, right_wall, lowest_slab };

/// Slabs of the silo's width one upon the other.
struct Silo {
  double width, slab_height;  ///< m
  double poisson, friction;
  int n_slabs;
  double height() const { return n_slabs * slab_height; }
  double weight() const { return density * gravity * width * height(); }
  /// sigma_xx / sigma_yy where walls prevent eps_xx, in plane strain.
  double pressure_ratio() const { return poisson / (1 - poisson); }
  /// Janssen's depth.
  double depth() const { return width / (2 * friction * pressure_ratio()); }
  double stress(double z) const { return -density * gravity * depth() * (1 - std::exp(-z / depth())); }
  double bottom() const { return -width * stress(height()); }
};

Scene silo_scene(const Silo& silo) {
  Scene scene = rock_scene(time_step, all_steps, 1e9);
  scene.analysis.block_model = BlockModel::affine;
  scene.contact.penetration_tolerance = 1e-9;  // a thousandth of it closed contacts may keep as a gap
  scene.materials = {{"slab", density, 1e9, silo.poisson}, {"wall", density, 1e9, silo.poisson}};
  Joint at_walls = scene.joints[0];
  at_walls.friction_angle = std::atan(silo.friction) * 360 / turn;
  at_walls.between = std::array{0, 1};
  scene.joints.push_back(at_walls);
  const double w = silo.width, play = 1e-3 * w;
  scene.blocks = {block(rectangle(-w / 2 + play, -w, w - 2 * play, w)),
                  block(rectangle(-1.5 * w, -w, w, silo.height() + 2 * w), true),
                  block(rectangle(0.5 * w, -w, w, silo.height() + 2 * w), true)};
  scene.blocks[left_wall].material = scene.blocks[right_wall].material = 1;
  for (int k = 0; k < silo.n_slabs; ++k)
    scene.blocks.push_back(block(rectangle(-w / 2, k * silo.slab_height, w, silo.slab_height)));
  Support support;
  support.block = floor_block;
  support.vertices = {0, 1, 2, 3};
  support.displacement = {TimeFunction::Kind::history,
                          Vec2::Zero(),
                          {{settling_steps * time_step, 0, 0}, {all_steps * time_step, 0, -sinking}}};
  scene.supports = {support};
  return scene;
}

struct Filled {
  double bottom = 0, bottom_before = 0;  ///< force on the floor while it sinks and before, over the weight
  double walls = 0;                      ///< friction of the walls while it sinks, over the weight
  double ratio_error = 0;                ///< of sigma_xx / sigma_yy, at most
  std::vector<double> depths, stresses;  ///< of the middles of the slabs, from below
};

Filled fill(const Silo& silo) {
  const BuiltScene built = build(silo_scene(silo));
  Filled filled;
  const auto on_floor = [&] {
    return normal_force_between(*built.stepper, floor_block, lowest_slab) / silo.weight();
  };
  run(*built.stepper, settling_steps);
  filled.bottom_before = on_floor();
  run(*built.stepper, all_steps - settling_steps);
  filled.bottom = on_floor();
  const Frame frame = capture_frame(*built.stepper, built.labels, {});
  for (const FrameContact& contact : frame.contacts) {
    const bool vertex_of_slab = contact.vertex_block >= lowest_slab,
               edge_of_slab = contact.edge_block >= lowest_slab;
    if (vertex_of_slab != edge_of_slab && std::min(contact.vertex_block, contact.edge_block) != floor_block)
      filled.walls += (vertex_of_slab ? 1 : -1) * contact.force().y() / silo.weight();
  }
  for (int k = 0; k < silo.n_slabs; ++k) {
    const auto stress = frame.mean_stress.col(lowest_slab + k);
    filled.depths.push_back((silo.n_slabs - k - 0.5) * silo.slab_height);
    filled.stresses.push_back(stress(1));
    filled.ratio_error =
        std::max(filled.ratio_error, std::abs(stress(0) / stress(1) / silo.pressure_ratio() - 1));
  }
  return filled;
}

/// Over the stress that Janssen's silo approaches.
double error_of_stresses(const Silo& silo, const Filled& filled) {
  double worst = 0;
  for (std::size_t k = 0; k < filled.depths.size(); ++k)
    worst = std::max(worst, std::abs(filled.stresses[k] - silo.stress(filled.depths[k])));
  return worst / (density * gravity * silo.depth());
}

}  // namespace

void silo(Report& report) {
  constexpr std::array silos{Silo{4, 0.5, 0.3, 0.5, 40}, Silo{2, 0.25, 0.2, 0.8, 48},
                             Silo{3, 0.4, 0.4, 0.2, 60}};
  report.heading("Janssen's silo");
  report.paragraph(
      "Janssen (1895) takes every horizontal slice of a silo's filling as uniformly stressed, with σxx = k "
      "σyy at walls on which it "
      "slides. So it is for slabs of the silo's width D that touch both walls: in plane strain k = ν/(1 − "
      "ν), no "
      "number being fitted. The walls alone have friction. The slabs settle in 0.6 s; then the floor sinks "
      "by 1 cm in 1.4 s, so that they slide on the "
      "walls; the tolerance of penetration is 1e-9. With z0 = D/(2 μ k):");
  report.paragraph("σyy(z) = −ρ g z0 (1 − exp(−z/z0)),  force on the floor = −D σyy(H).");

  std::vector<std::vector<std::string>> rows{{"D, m", "ν", "μ", "z0, m", "H, m", "slabs",
                                              "floor / weight, settled", "sinking", "Janssen", "error",
                                              "error of the slabs' σyy, of ρ g z0", "s"}};
  double worst = 0, ratio = 0, balance = 0;
  Chart chart{.x_symbol = {"depth z", "", ""},
              .y_symbol = {"−σ", "yy", ""},
              .x_unit = "m",
              .y_unit = "Pa",
              .series = {}};
  std::vector<Series> computed;
  for (const Silo& full : silos) {
    for (const int part : {4, 2, 1}) {
      Silo silo = full;
      silo.n_slabs = full.n_slabs / part;
      Filled filled;
      const double seconds = seconds_of([&] { filled = fill(silo); });
      const double janssen = silo.bottom() / silo.weight(), error = filled.bottom / janssen - 1;
      const double of_slabs = error_of_stresses(silo, filled);
      worst = std::max(worst, std::abs(error));
      ratio = std::max(ratio, filled.ratio_error);
      balance = std::max(balance, std::abs(filled.bottom + filled.walls - 1));
      rows.push_back({text(silo.width), text(silo.poisson), text(silo.friction),
                      fmt::format("{:.2f}", silo.depth()), text(silo.height()), std::to_string(silo.n_slabs),
                      fmt::format("{:.4f}", filled.bottom_before), fmt::format("{:.4f}", filled.bottom),
                      fmt::format("{:.4f}", janssen), text(error), text(of_slabs),
                      fmt::format("{:.1f}", seconds)});
      if (part > 1) continue;
      Series line{
          .name = fmt::format("Janssen, ν = {:g}, μ = {:g}", silo.poisson, silo.friction), .x = {}, .y = {}};
      for (double z = 0; z <= silo.height(); z += silo.height() / 100) {
        line.x.push_back(z);
        line.y.push_back(-silo.stress(z));
      }
      chart.series.push_back(line);
      Series points{.name = "slabs", .x = filled.depths, .y = filled.stresses, .markers = true};
      for (double& stress : points.y) stress = -stress;
      computed.push_back(points);
    }
  }
  chart.series.insert(chart.series.end(), computed.begin(), computed.end());
  report.table(rows);
  report.picture("dda_silo", draw({chart}, {.title = "Janssen's silo", .plot_height = 300}),
                 "The vertical stress over depth.");

  std::vector<double> errors;
  for (const double height : {1., 0.5, 0.25}) {
    const Silo silo{4, height, 0.3, 0.5, static_cast<int>(std::lround(12 / height))};
    errors.push_back(error_of_stresses(silo, fill(silo)));
  }
  const Silo smooth{4, 0.5, 0.3, 0, 40};
  const double carried = fill(smooth).bottom - 1;
  report.claims(
      {{"The force on the sinking floor is Janssen's to 1e-3, for every silo and filling height.",
        worst < 1e-3, text(worst)},
       {"The slabs press on the walls with k = ν/(1 − ν) of their σyy, to 1e-6.", ratio < 1e-6, text(ratio)},
       {"Floor and walls together carry the weight to 1e-5.", balance < 1e-5, text(balance)},
       {"Walls without friction carry nothing, to 1e-6 of the weight.", std::abs(carried) < 1e-6,
        text(carried)},
       {"Half as high slabs: a quarter of the error of σyy.",
        errors[1] < 0.3 * errors[0] && errors[2] < 0.3 * errors[1],
        fmt::format("{}, {}, {} of ρ g z0 with slabs of 1, 0.5, 0.25 m", text(errors[0]), text(errors[1]),
                    text(errors[2]))}});
}

}  // namespace validation
