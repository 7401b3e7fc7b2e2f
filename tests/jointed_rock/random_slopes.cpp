/// \file Random jointed slopes: what no admissible forces can hold has to move.
#include "chapters.hpp"
#include "sudden_weight.hpp"

#include <tests/support/random_slopes.hpp>
#include <tests/support/scene_changes.hpp>

#include <fmt/format.h>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace jointed_rock {

namespace {

constexpr double gravity = 9.8;             // m/s2
constexpr double below_limit = 0.97;        // of the limiting tan(phi): has to move
constexpr double above_dip = 1.2;           // of the larger of limit and steepest dip: has to rest
constexpr double steepest_held = 80;        // degrees: steeper dips are not tried with more friction
constexpr double seen_acceleration = 0.01;  // of a slab's: the error allowed

double degrees(double tangent) {
  return std::atan(tangent) * 180 / std::numbers::pi;
}

/// A slope that some friction holds and less does not.
struct Slope {
  std::uint64_t seed = 0;
  Scene scene;
  double limit = 0;     ///< tan(phi)
  double steepest = 0;  ///< tan of the steepest dip
  /// Of a single block on a plane of the limiting angle with so much less friction.
  double acceleration() const { return (1 - below_limit) * gravity * std::sin(std::atan(limit)); }
};

struct Slopes {
  std::vector<Slope> slopes;
  int never_held = 0;  ///< seeds between them that no friction holds
};

/// The first `n` of the seeds from 0 on that have a limit.
Slopes slopes_of(int n, const support::SlopeSize& size) {
  Slopes found;
  for (std::uint64_t seed = 0; static_cast<int>(found.slopes.size()) < n; ++seed) {
    Slope slope{seed, support::random_slope(seed, size)};
    const support::RigidBlocks blocks = support::rigid_blocks(slope.scene);
    const std::optional<double> limit = support::least_friction(blocks);
    if (!limit) ++found.never_held;
    if (!limit || *limit == 0) continue;
    slope.limit = *limit;
    slope.steepest = std::tan(support::steepest_dip(blocks));
    found.slopes.push_back(slope);
  }
  return found;
}

long n_free(const Scene& scene) {
  return std::count_if(scene.blocks.begin(), scene.blocks.end(),
                       [](const auto& block) { return !block.fixed; });
}

std::string figures(const Outcome& outcome) {
  return fmt::format("{} ({:.2g})", name_of(outcome.verdict), outcome.part);
}

/// How often each verdict was seen.
class Counts {
 public:
  void add(const Outcome& outcome) {
    ++n_;
    ++of_[outcome.verdict];
  }
  int n() const { return n_; }
  int of(Verdict verdict) const { return of_.contains(verdict) ? of_.at(verdict) : 0; }
  bool all(Verdict verdict) const { return n_ > 0 && of(verdict) == n_; }
  std::string text() const {
    std::string text = fmt::format("of {}", n_);
    for (const auto& [verdict, n] : of_) text += fmt::format(", {} {}", n, name_of(verdict));
    return text;
  }

 private:
  int n_ = 0;
  std::map<Verdict, int> of_;
};

/// The same slope mirrored, and with blocks and vertices numbered the other way round.
struct Restated {
  bool same_verdict = true;
  double apart = 0;  ///< largest difference of displacements over the largest displacement
};

Restated restated(const Slope& slope, const Outcome& as_it_is) {
  const auto n_blocks = static_cast<int>(slope.scene.blocks.size());
  std::vector<int> order;
  for (int b = 0; b < n_blocks; ++b) order.push_back(n_blocks - 1 - b);
  const double friction = below_limit * slope.limit, acceleration = slope.acceleration();
  const Mat2 mirror = (Mat2() << -1, 0, 0, 1).finished();
  const Outcome mirrored = let_go(support::turned(slope.scene, mirror), friction, acceleration),
                renumbered = let_go(support::renumbered(support::reordered(slope.scene, order), 1), friction,
                                    acceleration);
  Restated seen;
  for (const Outcome* other : {&mirrored, &renumbered})
    seen.same_verdict = seen.same_verdict && other->verdict == as_it_is.verdict;
  for (std::size_t b = 0; b < slope.scene.blocks.size(); ++b) {
    const Points& here = as_it_is.vertices[b];
    const Points& moved_on = renumbered.vertices[slope.scene.blocks.size() - 1 - b];
    for (Eigen::Index k = 0; k < here.cols(); ++k)
      seen.apart = std::max({seen.apart, (mirror * mirrored.vertices[b].col(k) - here.col(k)).norm(),
                             (moved_on.col((k + 1) % here.cols()) - here.col(k)).norm()});
  }
  seen.apart /= as_it_is.displacement;
  return seen;
}

struct Sample {
  int n_slopes = 0;
  support::SlopeSize size;
  int n_restated = 0;  ///< of them, mirrored and renumbered too
};

void slopes(Report& report, const Sample& sample) {
  const Slopes found = slopes_of(sample.n_slopes, sample.size);
  report.paragraph(fmt::format("{} slopes of {} to {} blocks; {} more are held by no friction and left out.",
                               sample.n_slopes, sample.size.least, sample.size.most, found.never_held));
  std::vector<std::vector<std::string>> rows{{"seed", "free blocks", "limiting φ", "steepest dip",
                                              "φ below it", "is seen", "mirrored, renumbered", "φ above both",
                                              "is seen"}};
  Counts below, above;
  int same = 0, n_restated = 0;
  double apart = 0;
  for (const Slope& slope : found.slopes) {
    const Outcome moving = let_go(slope.scene, below_limit * slope.limit, slope.acceleration());
    below.add(moving);
    rows.push_back({std::to_string(slope.seed), std::to_string(n_free(slope.scene)),
                    fmt::format("{:.2f}°", degrees(slope.limit)),
                    fmt::format("{:.2f}°", degrees(slope.steepest)),
                    fmt::format("{:.2f}°", degrees(below_limit * slope.limit)), figures(moving), "", "", ""});
    std::vector<std::string>& row = rows.back();
    if (n_restated < sample.n_restated) {
      const Restated seen = restated(slope, moving);
      ++n_restated;
      same += seen.same_verdict;
      apart = std::max(apart, seen.apart);
      row[6] = fmt::format("{}, {:.1e}", seen.same_verdict ? "the same" : "**not the same**", seen.apart);
    }
    if (degrees(slope.steepest) > steepest_held) continue;
    const double rough = above_dip * std::max(slope.limit, slope.steepest);
    const Outcome resting = let_go(slope.scene, rough, slope.acceleration());
    above.add(resting);
    row[7] = fmt::format("{:.2f}°", degrees(rough));
    row[8] = figures(resting);
  }
  report.table(rows);
  report.claims(
      {{fmt::format("Slopes of {} to {} blocks move with {} % of the friction that could hold them.",
                    sample.size.least, sample.size.most, 100 * below_limit),
        below.all(Verdict::moves), below.text()},
       {fmt::format(
            "Slopes of {} to {} blocks rest where no block can slide on any face and forces can hold them.",
            sample.size.least, sample.size.most),
        above.all(Verdict::rests), above.text()},
       {fmt::format("Slopes of {} to {} blocks do the same when mirrored and renumbered.", sample.size.least,
                    sample.size.most),
        same == n_restated,
        fmt::format("{} of {}; at most {:.1e} of the displacement apart", same, n_restated, apart)}});
}

void slabs(Report& report, int n_slabs) {
  report.paragraph(
      "Slabs: one to four layers of up to eight blocks each on a plane, wider than what topples, so that "
      "every motion is "
      "sliding along it. With 97 % of tan(dip) they slide by g (sin − cos tan φ), with 103 % they rest.");
  std::vector<std::vector<std::string>> rows{
      {"seed", "free blocks", "dip", "97 %: acceleration over g (sin − cos tan φ)", "103 %"}};
  Counts below, above;
  double worst = 0;
  for (int k = 0; k < n_slabs; ++k) {
    const auto seed = static_cast<std::uint64_t>(k);
    const support::Slab slab = support::random_slab(seed);
    const double limit = std::tan(slab.dip), acceleration = (1 - below_limit) * gravity * std::sin(slab.dip);
    // A little more than the way, so that all of the time is watched.
    const Outcome sliding = let_go(slab.scene, below_limit * limit, 1.5 * acceleration),
                  resting = let_go(slab.scene, (2 - below_limit) * limit, acceleration);
    below.add(sliding);
    above.add(resting);
    double error = 0;
    for (std::size_t b = 0; b < slab.scene.blocks.size(); ++b) {
      if (slab.scene.blocks[b].fixed) continue;
      const double way = sliding.vertices[b].rowwise().mean().norm();
      error = std::max(error, std::abs(2 * way / (acceleration * sliding.time * sliding.time) - 1));
    }
    worst = std::max(worst, error);
    rows.push_back(
        {std::to_string(k), std::to_string(n_free(slab.scene)), fmt::format("{:.2f}°", degrees(limit)),
         sliding.verdict == Verdict::stops ? "stops" : fmt::format("1 ± {:.1e}", error), figures(resting)});
  }
  report.table(rows);
  report.claims({{"Slabs slide by g (sin − cos tan φ), every block within 1 %.",
                  below.of(Verdict::stops) == 0 && worst <= seen_acceleration,
                  fmt::format("{}; {:.1e}", below.text(), worst)},
                 {"Slabs rest with 103 % of tan(dip).", above.all(Verdict::rests), above.text()}});
}

void chapter(Report& report, const std::vector<Sample>& samples, int n_slabs) {
  report.heading("Random slopes");
  report.paragraph(
      fmt::format("Slopes 20 m high, cut by two or three joint sets (`tests/support/random_slopes`), let go "
                  "from rest under their weight, "
                  "Δt = {} s. The limiting tan φ is the least at which admissible forces exist: a linear "
                  "program of the static theorem, "
                  "bisected. Below it no law of flow can hold the slope; it moves when within {} s a vertex "
                  "has come {} % as far as "
                  "a = g sin φ ({:.2f}) of a single block takes it, and rests below a tenth of that; the "
                  "ratio to a t²/2 is in "
                  "brackets. Above "
                  "it sliding may still be possible, since joints do not dilate by φ. What has to stand is "
                  "asked where φ is larger "
                  "than every dip as well (tan φ 1.2 times the larger of both): no block slides by its "
                  "weight on any face.",
                  time_step, watched, 100 * moving_part, 1 - below_limit));
  for (const Sample& sample : samples) slopes(report, sample);
  slabs(report, n_slabs);
}

}  // namespace

void random_slopes(Report& report) {
  chapter(report, {{6, {}, 2}}, 6);
}

void all_random_slopes(Report& report) {
  chapter(report, {{200, {}, 30}, {20, {190, 210}, 0}}, 100);
}

}  // namespace jointed_rock
