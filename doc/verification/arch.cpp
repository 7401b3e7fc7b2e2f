#include "chapters.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <ddacontact/output/block_summary.hpp>
#include <ddacontact/picture/picture.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace verification {

namespace {

constexpr int n_blocks = 7, crown = 3, n_steps = 30;
constexpr std::array springers{0, 6};
constexpr std::array middle{1, 2, 3, 4, 5};

std::string kpa(double stress) {
  return fmt::format("{:.2f}", stress / 1e3);
}

struct Seen {
  std::vector<Sample> all;
  Extremes extremes;
  Vec2 centroid;
  double size;
};

std::vector<Seen> evaluate(const Frame& frame) {
  std::vector<Seen> seen;
  for (int b = 0; b < n_blocks; ++b) {
    const std::vector<Sample> all = samples(frame, b);
    const polyfem::AreaMoments moments = polyfem::area_moments(frame.outline(b));
    seen.push_back({all, extremes(all), moments.centroid, std::sqrt(moments.area)});
  }
  return seen;
}

double mean(const std::vector<Sample>& all, double Sample::*stress, const auto& where) {
  double sum = 0;
  int n = 0;
  for (const Sample& s : all)
    if (where(s)) sum += s.*stress, ++n;
  return sum / n;
}

/// Stress of a springer near its fixed joint less that near the next block. Its joints point to the centre of
/// the arch, so where along the block a point lies is told by its height.
std::array<double, 2> ends(const Seen& springer, double Sample::*stress) {
  const double low = springer.centroid.y() - 0.3 * springer.size,
               high = springer.centroid.y() + 0.3 * springer.size;
  return {mean(springer.all, stress, [&](const Sample& s) { return s.position.y() < low; }),
          mean(springer.all, stress, [&](const Sample& s) { return s.position.y() > high; })};
}

/// How far from the arch's centre on average, relative to the block's middle: > 0 is the top.
double height_of(const Vec2& position, const Seen& block) {
  return position.norm() - block.centroid.norm();
}

void picture(Report& report, const std::string& name, const std::string& caption, const Run& affine,
             const Run& wachspress, RangeSharing sharing) {
  std::vector<Panel> panels;
  for (const Field field : {Field::s1, Field::s2})
    for (const auto& [run, model] :
         {std::pair{&affine, model_names[0]}, std::pair{&wachspress, model_names[1]}})
      panels.push_back({.frame = &run->frame, .field = field, .caption = model});
  report.picture(name, draw(panels, {.title = caption, .width = 900, .columns = 2, .sharing = sharing}),
                 caption);
}

/// Of the blocks' averages, relative to the largest range within a block.
double means_apart(const Run& affine, const Run& wachspress) {
  double range = 0;
  for (int b = 0; b < n_blocks; ++b) {
    const StressRange stress =
        stress_range(wachspress.stepper().blocks().block(b), wachspress.stepper().state());
    range = std::max(range, (stress.max - stress.min).maxCoeff());
  }
  return (affine.frame.mean_stress - wachspress.frame.mean_stress).cwiseAbs().maxCoeff() / range;
}

/// The part of the normal force between two blocks that is carried further from the arch's centre than the
/// middle of the ring.
double outer_share(const Frame& frame, int block_a, int block_b) {
  constexpr double middle_radius = (1 + 1.339434) / 2;
  double outer = 0, total = 0;
  for (const FrameContact& contact : frame.contacts) {
    const auto [low, high] = std::minmax(contact.vertex_block, contact.edge_block);
    if (low != block_a || high != block_b) continue;
    total += contact.normal_force;
    if (contact.position.norm() > middle_radius) outer += contact.normal_force;
  }
  return outer / total;
}

double configurations_apart(const Run& affine, const Run& wachspress) {
  return (affine.frame.position - wachspress.frame.position).colwise().norm().maxCoeff() / std::sqrt(0.17227);
}

double largest_displacement(const Run& run) {
  return run.frame.displacement.colwise().norm().maxCoeff();
}

void frictionless(Report& report) {
  const Run affine = run_scene("arch_frictionless", "affine", n_steps);
  const Run wachspress = run_scene("arch_frictionless", "wachspress", n_steps);
  report.paragraph("### Without friction (figure 11)");
  picture(report, "arch_frictionless", "Figure 11: the arch without friction after 30 steps", affine,
          wachspress, RangeSharing::rows);
  const std::vector<Seen> seen = evaluate(wachspress.frame);
  const auto left = ends(seen[0], &Sample::s1), right = ends(seen[6], &Sample::s1);
  const auto left2 = ends(seen[0], &Sample::s2), right2 = ends(seen[6], &Sample::s2);
  const auto variation = [&](int b) { return seen[b].extremes.most_s1.s1 - seen[b].extremes.least_s1.s1; };
  double middle_variation = 0;
  for (const int b : middle) middle_variation = std::max(middle_variation, variation(b));
  const double outer_variation = std::min(variation(0), variation(6));
  report.claims({
      {"Both models give a similar configuration.", configurations_apart(affine, wachspress) < 0.1,
       fmt::format("No vertex differs by more than {:.1f} % of a block's size, after displacements of up to "
                   "{:.2f} m.",
                   100 * configurations_apart(affine, wachspress), largest_displacement(wachspress))},
      {"In the outermost blocks σ1 and σ2 are negative near the fixed joint and change to positive towards "
       "the centre.",
       left[0] < 0 && right[0] < 0 && left2[0] < 0 && right2[0] < 0 && left[1] > 0 && right[1] > 0,
       fmt::format("σ1 from {} to {} kPa, σ2 from {} to {} kPa on average at the two ends of the left block. "
                   "The next block rests on one corner of it, so that "
                   "it is bent: compressed on the side of that corner, not at one end.",
                   kpa(left[0]), kpa(left[1]), kpa(left2[0]), kpa(left2[1]))},
      {"In the middle blocks stresses vary little.", middle_variation < outer_variation,
       fmt::format(
           "σ1 varies by at most {} kPa within one of them, by {} kPa in the outermost ones: the haunches "
           "rest on single corners and are bent.",
           kpa(middle_variation), kpa(outer_variation))},
      {"The original DDA's results are close to the averages of the new formulation.",
       means_apart(affine, wachspress) < 0.1,
       fmt::format("Block averages differ by at most {:.1f} % of the largest range within a block.",
                   100 * means_apart(affine, wachspress))},
  });
}

void with_friction(Report& report) {
  const Run affine = run_scene("arch_friction30", "affine", n_steps);
  const Run wachspress = run_scene("arch_friction30", "wachspress", n_steps);
  report.paragraph("### Friction angle 30 degrees (figures 12 and 13)");
  picture(report, "arch_friction30", "Figures 12 and 13: the arch with friction after 30 steps", affine,
          wachspress, RangeSharing::rows);
  const std::vector<Seen> seen = evaluate(wachspress.frame);
  bool affine_negative = true, bottom = true, top = true, biaxial_everywhere = true;
  double negative_part = 0, larger_part = 0;
  for (const Seen& block : seen) {
    larger_part +=
        part(block.all, [](const Sample& s) { return std::abs(s.s2) > std::abs(s.s1); }) / n_blocks;
    negative_part += part(block.all, [](const Sample& s) { return s.s2 < 0; }) / n_blocks;
    biaxial_everywhere = biaxial_everywhere && block.extremes.most_s1.s1 < 0;
  }
  for (const int b : middle) bottom = bottom && height_of(seen[b].extremes.least_s2.position, seen[b]) < 0;
  for (const int b : springers) top = top && height_of(seen[b].extremes.least_s2.position, seen[b]) > 0;
  for (int b = 0; b < n_blocks; ++b)
    affine_negative = affine_negative && polyfem::principal_stresses(affine.frame.mean_stress.col(b)).s2 < 0;
  const auto left = ends(seen[0], &Sample::s1), right = ends(seen[6], &Sample::s1);
  const Seen& key = seen[crown];
  const double up = mean(key.all, &Sample::s1,
                         [&](const Sample& s) { return s.position.y() > key.centroid.y() + 0.2 * key.size; });
  const double down = mean(key.all, &Sample::s1, [&](const Sample& s) {
    return s.position.y() < key.centroid.y() - 0.2 * key.size;
  });
  report.claims({
      {"The arch is stable.", largest_displacement(wachspress) < 0.01 && largest_displacement(affine) < 0.01,
       fmt::format(
           "No vertex has moved by more than {:.2f} % of the radius, in 300 steps by 0.07 % (a test).",
           100 * largest_displacement(wachspress))},
      {"σ2 is negative throughout and larger than σ1 in magnitude.",
       affine_negative && negative_part == 1 && larger_part == 1,
       fmt::format("At {:.1f} % of the points, and larger at {:.1f} %. The rest is at the bottom of the "
                   "crown block, which is bent by "
                   "its load.",
                   100 * negative_part, 100 * larger_part)},
      {"In the middle blocks σ2 is least at the bottom.", bottom,
       fmt::format("In the haunches. The crown is pressed at the top: {:.0f} % of the thrust beside it goes "
                   "through the outer "
                   "contact, {:.0f} % between haunch and springer. That is the line of thrust of a half "
                   "circle, high at the crown and "
                   "low at the haunches; the paper prints no shape of its arch, and its figures are those of "
                   "a thrust line low at the "
                   "crown.",
                   100 * outer_share(wachspress.frame, 2, 3), 100 * outer_share(wachspress.frame, 0, 1))},
      {"In the outermost blocks it is least at the top.", top,
       "Least at the bottom, by the same line of thrust."},
      {"Most blocks are not in biaxial compression everywhere.", !biaxial_everywhere,
       "σ1 > 0 somewhere in them."},
      {"In an outermost block σ1 changes from negative to positive towards the centre.",
       left[0] < 0 && left[1] > 0 && right[0] < 0 && right[1] > 0,
       fmt::format("From {} to {} kPa on average at its two ends.", kpa(left[0]), kpa(left[1]))},
      {"In the central block σ1 changes from positive to negative downwards.", up > 0 && down < 0,
       fmt::format("{} kPa at the top, {} kPa at the bottom on average: the thrust passes at the top.",
                   kpa(up), kpa(down))},
  });
}

}  // namespace

void arch_bridge(Report& report) {
  report.heading("5.2 An arch of seven blocks");
  report.paragraph(
      "Seven equal blocks of 0.17227 m2 over a half circle of inner radius 1 m, 50 N on the crown, 30 steps "
      "of 0.01 s. Scenes: "
      "`arch_frictionless.toml`, `arch_friction30.toml`.");
  frictionless(report);
  with_friction(report);
}

}  // namespace verification
