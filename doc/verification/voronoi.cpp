#include "chapters.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <ddacontact/picture/picture.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace verification {

namespace {

constexpr int n_rows = 6, pushed_block = 62;

std::string mpa(double stress) {
  return fmt::format("{:.3f}", stress / 1e6);
}

/// Least principal mean stress of each block.
double block_s2(const Frame& frame, int block) {
  return polyfem::principal_stresses(frame.mean_stress.col(block)).s2;
}
double block_s1(const Frame& frame, int block) {
  return polyfem::principal_stresses(frame.mean_stress.col(block)).s1;
}

/// Average of the blocks' σ2 in each of the rows between the top and the ramp, by the depth of their
/// centroids below the free surface.
std::vector<double> s2_by_depth(const Frame& frame) {
  double top = -std::numeric_limits<double>::infinity(), bottom = -top;
  std::vector<double> heights{0};
  for (int b = 1; b < frame.n_blocks(); ++b) {
    heights.push_back(polyfem::area_moments(frame.outline(b)).centroid.y());
    top = std::max(top, heights.back());
    bottom = std::min(bottom, heights.back());
  }
  std::vector<double> sums(n_rows, 0);
  std::vector<int> counts(n_rows, 0);
  for (int b = 1; b < frame.n_blocks(); ++b) {
    const int row = std::min(n_rows - 1, static_cast<int>(n_rows * (top - heights[b]) / (top - bottom)));
    sums[row] += block_s2(frame, b);
    ++counts[row];
  }
  for (int row = 0; row < n_rows; ++row) sums[row] /= counts[row];
  return sums;
}

struct Field1 {
  double least = std::numeric_limits<double>::infinity(), most = -least, positive = 0, biaxial = 0;
};

/// σ1 over all free blocks: its range, and where it is positive.
Field1 compare_s1(const Frame& frame) {
  Field1 seen;
  double area = 0;
  for (int b = 1; b < frame.n_blocks(); ++b) {
    const std::vector<Sample> all = samples(frame, b);
    const Extremes e = extremes(all);
    const double of_block = polyfem::area_moments(frame.outline(b)).area;
    seen.least = std::min(seen.least, e.least_s1.s1);
    seen.most = std::max(seen.most, e.most_s1.s1);
    seen.positive += of_block * part(all, [](const Sample& s) { return s.s1 > 0; });
    seen.biaxial += of_block * part(all, [](const Sample& s) { return s.s1 < 0 && s.s2 < 0; });
    area += of_block;
  }
  seen.positive /= area;
  seen.biaxial /= area;
  return seen;
}

struct Pair {
  Run affine, wachspress;
};

Pair run_both(const std::string& scene) {
  return {run_scene(scene, "affine"), run_scene(scene, "wachspress")};
}

void picture(Report& report, const std::string& name, const std::string& caption, const Pair& runs) {
  std::vector<Panel> panels;
  for (const Field field : {Field::s1, Field::s2})
    for (const auto& [run, model] :
         {std::pair{&runs.affine, model_names[0]}, std::pair{&runs.wachspress, model_names[1]}})
      panels.push_back({.frame = &run->frame, .field = field, .caption = model});
  report.picture(name,
                 draw(panels, {.title = caption, .width = 1000, .columns = 2, .sharing = RangeSharing::rows}),
                 caption);
}

Claim same_configuration(const Pair& runs) {
  double apart = (runs.affine.frame.position - runs.wachspress.frame.position).colwise().norm().maxCoeff();
  double smallest = std::numeric_limits<double>::infinity();
  for (int b = 1; b < runs.affine.frame.n_blocks(); ++b)
    smallest = std::min(smallest, runs.affine.stepper().blocks().block(b).size());
  return {"Both models give the same configuration.", apart < 0.01 * smallest,
          fmt::format("No vertex differs by more than {:.4f} % of the smallest block's size.",
                      100 * apart / smallest)};
}

Claim settled(const Pair& runs) {
  const StepCounts &a = runs.affine.stepper().counts(), &w = runs.wachspress.stepper().counts();
  return {
      "55 steps are computed.", a.unconverged + w.unconverged == 0,
      fmt::format("All of them settled: original DDA {} solutions, {} rejected tries; Wachspress {} and {}.",
                  a.contact_iterations, a.rejected, w.contact_iterations, w.rejected)};
}

std::string rows_text(const std::vector<double>& rows) {
  std::string text;
  for (const double s : rows) text += (text.empty() ? "" : ", ") + mpa(s);
  return text;
}

bool falls(const std::vector<double>& rows) {
  return std::is_sorted(rows.begin(), rows.end(), [](double a, double b) { return a > b; });
}

}  // namespace

void voronoi_slope(Report& report) {
  report.heading("5.3 Voronoi blocks on a ramp");
  const Pair gravity = run_both("voronoi_gravity"), push = run_both("voronoi_push");
  report.paragraph(
      fmt::format("{} Voronoi blocks (`dda make voronoi`; the paper prints neither their shapes nor their "
                  "sizes) lie on a fixed ramp. They have E = 10 GPa, friction 40 degrees, cohesion 1 MPa, "
                  "static steps of 0.01 s. Scenes: `voronoi_gravity.toml`, `voronoi_push.toml`.",
                  gravity.wachspress.frame.n_blocks() - 1));
  report.paragraph("### Under gravity (figure 15)");
  picture(report, "voronoi_gravity", "Figure 15: Voronoi blocks under gravity after 55 steps", gravity);
  const std::vector<double> rows = s2_by_depth(gravity.wachspress.frame),
                            affine_rows = s2_by_depth(gravity.affine.frame);
  bool compressive = true;
  for (int b = 1; b < gravity.affine.frame.n_blocks(); ++b)
    compressive =
        compressive && block_s2(gravity.wachspress.frame, b) < 0 && block_s2(gravity.affine.frame, b) < 0;
  const Field1 s1 = compare_s1(gravity.wachspress.frame);
  double mean_s1 = 0, mean_s2 = 0;
  for (int b = 1; b < gravity.wachspress.frame.n_blocks(); ++b) {
    mean_s1 += std::abs(block_s1(gravity.wachspress.frame, b));
    mean_s2 += std::abs(block_s2(gravity.wachspress.frame, b));
  }
  report.claims({
      settled(gravity),
      same_configuration(gravity),
      {"σ2 is negative throughout.", compressive, "The block means of both models are."},
      {"Its magnitude grows downwards.", falls(rows) && falls(affine_rows),
       fmt::format("Means of {} rows from the top, MPa: Wachspress {}; original DDA {}.", n_rows,
                   rows_text(rows), rows_text(affine_rows))},
      {"σ1 is small compared with σ2.", mean_s1 < 0.5 * mean_s2,
       fmt::format("The block means of its magnitude are {:.0f} % of those of σ2.", 100 * mean_s1 / mean_s2)},
      {"Stresses concentrate at some vertices, where contact forces act: σ1 ranges from -18.54 to 18.04 (as "
       "printed, N/mm2).",
       s1.least < 0 && s1.most > 5 * mean_s1 / (gravity.wachspress.frame.n_blocks() - 1),
       fmt::format("σ1 ranges from {} to {} MPa inside blocks.", mpa(s1.least), mpa(s1.most))},
  });

  report.paragraph("### With a push of 200 kN at the upper left block (figure 17)");
  picture(report, "voronoi_push", "Figure 17: Voronoi blocks pushed to the right after 55 steps", push);
  const Field1 pushed = compare_s1(push.wachspress.frame);
  int n_growing = 0, most_pressed = 1;
  double least_s1 = 0;
  for (int b = 1; b < push.wachspress.frame.n_blocks(); ++b) {
    const Extremes before = extremes(samples(gravity.wachspress.frame, b));
    const Extremes after = extremes(samples(push.wachspress.frame, b));
    n_growing += after.most_s1.s1 > before.most_s1.s1;
    if (after.least_s1.s1 < least_s1) {
      least_s1 = after.least_s1.s1;
      most_pressed = b;
    }
  }
  report.claims({
      settled(push),
      same_configuration(push),
      {"Most regions are in biaxial compression.", pushed.biaxial > 0.5,
       fmt::format("{:.0f} % of the area, {:.0f} % under gravity alone.", 100 * pushed.biaxial,
                   100 * s1.biaxial)},
      {"The upper left block presents the largest compression σ1.", most_pressed == pushed_block,
       fmt::format("{} MPa in block {}; the push acts on block {}.", mpa(least_s1), most_pressed,
                   pushed_block)},
      {"The area with positive σ1 decreases.", pushed.positive < s1.positive,
       fmt::format("From {:.0f} to {:.0f} %.", 100 * s1.positive, 100 * pushed.positive)},
      {"σ1 increases around some joints, which pass the push on.", n_growing > 0,
       fmt::format("The largest σ1 grows in {} of {} blocks.", n_growing,
                   push.wachspress.frame.n_blocks() - 1)},
  });
}

}  // namespace verification
