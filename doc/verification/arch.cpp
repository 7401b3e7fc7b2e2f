#include "chapters.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/picture.hpp>
#include <polyfem/geometry/area_moments.hpp>

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

std::vector<Seen> look_at(const Frame& frame) {
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

double means_apart(const Run& affine, const Run& wachspress) {
  return (affine.frame.mean_stress - wachspress.frame.mean_stress).cwiseAbs().maxCoeff() /
         wachspress.frame.mean_stress.cwiseAbs().maxCoeff();
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
  const std::vector<Seen> seen = look_at(wachspress.frame);
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
       fmt::format("σ1 from {} to {} kPa, σ2 from {} to {} kPa on average at the two ends of the left block.",
                   kpa(left[0]), kpa(left[1]), kpa(left2[0]), kpa(left2[1]))},
      {"In the middle blocks stresses vary little.", middle_variation < outer_variation,
       fmt::format("σ1 varies by at most {} kPa within one of them, by {} kPa in the outermost ones.",
                   kpa(middle_variation), kpa(outer_variation))},
      {"The original DDA's results are close to the averages of the new formulation.",
       means_apart(affine, wachspress) < 0.1,
       fmt::format("Block averages differ by at most {:.1f} % of the largest.",
                   100 * means_apart(affine, wachspress))},
  });
}

void with_friction(Report& report) {
  const Run affine = run_scene("arch_friction30", "affine", n_steps);
  const Run wachspress = run_scene("arch_friction30", "wachspress", n_steps);
  report.paragraph("### Friction angle 30 degrees (figures 12 and 13)");
  picture(report, "arch_friction30", "Figures 12 and 13: the arch with friction after 30 steps", affine,
          wachspress, RangeSharing::rows);
  const std::vector<Seen> seen = look_at(wachspress.frame);
  bool negative = true, larger = true, bottom = true, top = true, biaxial_everywhere = true;
  double most_s2 = -1e300;
  for (const Seen& block : seen) {
    most_s2 = std::max(most_s2, block.extremes.most_s2.s2);
    negative = negative && block.extremes.most_s2.s2 < 0;
    larger = larger && part(block.all, [](const Sample& s) { return std::abs(s.s2) > std::abs(s.s1); }) == 1;
    biaxial_everywhere = biaxial_everywhere && block.extremes.most_s1.s1 < 0;
  }
  for (const int b : middle) bottom = bottom && height_of(seen[b].extremes.least_s2.position, seen[b]) < 0;
  for (const int b : springers) top = top && height_of(seen[b].extremes.least_s2.position, seen[b]) > 0;
  for (Index b = 0; b < affine.frame.mean_stress.cols(); ++b) {
    const Vec3 s = affine.frame.mean_stress.col(b);
    negative = negative && (s[0] + s[1]) / 2 + std::hypot((s[0] - s[1]) / 2, s[2]) * -1 < 0;
  }
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
      {"σ2 is negative throughout and larger than σ1 in magnitude.", negative && larger,
       fmt::format("The largest σ2 anywhere is {} kPa.", kpa(most_s2))},
      {"In the middle blocks σ2 is least at the bottom.", bottom,
       fmt::format("σ2 = {}, {}, {}, {}, {} kPa there.", kpa(seen[1].extremes.least_s2.s2),
                   kpa(seen[2].extremes.least_s2.s2), kpa(seen[3].extremes.least_s2.s2),
                   kpa(seen[4].extremes.least_s2.s2), kpa(seen[5].extremes.least_s2.s2))},
      {"In the outermost blocks it is least at the top.", top,
       fmt::format("{} and {} kPa.", kpa(seen[0].extremes.least_s2.s2), kpa(seen[6].extremes.least_s2.s2))},
      {"Most blocks are not in biaxial compression everywhere.", !biaxial_everywhere,
       "σ1 > 0 somewhere in them."},
      {"In an outermost block σ1 changes from negative to positive towards the centre.",
       left[0] < 0 && left[1] > 0 && right[0] < 0 && right[1] > 0,
       fmt::format("From {} to {} kPa on average at its two ends.", kpa(left[0]), kpa(left[1]))},
      {"In the central block σ1 changes from positive to negative downwards.", up > 0 && down < 0,
       fmt::format("{} kPa at the top, {} kPa at the bottom on average.", kpa(up), kpa(down))},
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
