/// \file Random jointed slopes: what no admissible forces can hold has to move.
#include "chapters.hpp"
#include "slope_study.hpp"

#include <ddacontact/scene/builder.hpp>
#include <tests/support/limit_analysis.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <utility>

namespace jointed_rock {

namespace {

constexpr int n_sample = 6, n_sample_restated = 2, n_slabs = 6;
constexpr double slab_error = 0.01;  // of the acceleration

std::string text(const std::optional<Seen>& seen) {
  return seen ? fmt::format("{} ({:.2g})", name_of(seen->verdict), seen->part) : "";
}

/// How often each verdict was seen.
class Counts {
 public:
  void add(const std::optional<Seen>& seen) {
    if (!seen) return;
    ++n_;
    ++of_[seen->verdict];
  }
  bool all(Verdict verdict) const { return n_ > 0 && of_.contains(verdict) && of_.at(verdict) == n_; }
  std::string text() const {
    std::string text = fmt::format("of {}", n_);
    for (const auto& [verdict, n] : of_) text += fmt::format(", {} {}", n, name_of(verdict));
    return text;
  }

 private:
  int n_ = 0;
  std::map<Verdict, int> of_;
};

std::vector<Claim> claims(const std::string& slopes, const std::vector<SlopeResult>& results) {
  Counts below, rough;
  int n_restated = 0, n_same = 0;
  double apart = 0;
  for (const SlopeResult& result : results) {
    below.add(result.below);
    rough.add(result.rough);
    if (!result.restated) continue;
    ++n_restated;
    n_same += result.restated->same_verdict;
    apart = std::max(apart, result.restated->apart);
  }
  std::vector<Claim> claims{{slopes + " move with 97 % of the friction that could hold them.",
                             below.all(Verdict::moves), below.text()},
                            {slopes + " rest where φ is larger than the limit and every dip.",
                             rough.all(Verdict::rests), rough.text()}};
  if (n_restated > 0)
    claims.push_back(
        {slopes + " do the same mirrored and renumbered.", n_same == n_restated,
         fmt::format("{} of {}, at most {:.1e} of the displacement apart", n_same, n_restated, apart)});
  return claims;
}

void sample(Report& report) {
  Slopes slopes({});
  std::vector<SlopeResult> results;
  for (int k = 0; k < n_sample; ++k) results.push_back(study(slopes.next(), k < n_sample_restated));
  std::vector<std::vector<std::string>> rows{{"seed", "free blocks", "limiting φ", "steepest dip",
                                              "97 % of tan φ", "mirrored, renumbered", "110 %",
                                              "120 % of both"}};
  for (const SlopeResult& result : results)
    rows.push_back({std::to_string(result.seed), std::to_string(result.n_free),
                    fmt::format("{:.2f}°", degrees(result.limit)),
                    fmt::format("{:.2f}°", degrees(result.steepest)), text(result.below),
                    result.restated ? fmt::format("{}, {:.1e} apart",
                                                  result.restated->same_verdict ? "the same" : "**not**",
                                                  result.restated->apart)
                                    : "",
                    text(result.above), text(result.rough)});
  report.paragraph(
      fmt::format("### A sample\n\nThe first {} that have a limit; {} between them are held by no friction.",
                  n_sample, slopes.n_never_held()));
  report.table(rows);
  report.claims(claims("Of the sample, slopes", results));
}

bool is_large(const SlopeResult& result) {
  return result.n_free > 100;
}

std::vector<SlopeResult> recorded() {
  std::ifstream in(POLYDDA_ALL_SLOPES);
  if (!in) throw Error("cannot read \"" POLYDDA_ALL_SLOPES "\"");
  std::vector<SlopeResult> results;
  for (std::string line; std::getline(in, line);) results.push_back(read_record_line(line));
  return results;
}

void all(Report& report) {
  std::map<bool, std::vector<SlopeResult>> by_size;  // whether of 200 blocks
  for (const SlopeResult& result : recorded()) by_size[is_large(result)].push_back(result);
  report.paragraph(
      "### All\n\nAs `build/release/tests/jointed_rock/jointed_rock_all` (an hour; `ctest -L long` makes it "
      "anew and compares) "
      "has written it to `tests/jointed_rock/all_slopes.csv`. With 110 % of the limiting tan φ:");
  std::vector<std::vector<std::string>> rows{{"slopes", "110 %"}};
  std::vector<Claim> all_claims;
  for (const auto& [large, results] : by_size) {
    const std::string name = large ? "of 200 blocks" : "of 20 to 60 blocks";
    Counts above;
    for (const SlopeResult& result : results) above.add(result.above);
    rows.push_back({name, above.text()});
    const std::vector<Claim> of_size = claims("Slopes " + name, results);
    all_claims.insert(all_claims.end(), of_size.begin(), of_size.end());
  }
  report.table(rows);
  report.claims(all_claims);
}

/// What holds a slope in the end that nothing could hold at the start.
struct Hold {
  double slip = 0;        ///< largest displacement of a vertex, m
  double unbalanced = 0;  ///< see Equilibrium
  int n_bearing = 0;      ///< pairs of blocks that press on each other
  int n_new = 0;          ///< of these, pairs without a common face at the start
  double share = 0;       ///< of the normal forces, on those
};

Hold what_holds(const Slope& slope) {
  Scene scene = slope.scene;
  scene.joints[0].friction_angle = degrees(below_limit * slope.limit);
  scene.analysis.time_step = time_step;
  scene.analysis.steps = static_cast<int>(std::lround(watched / time_step));
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  std::set<std::pair<int, int>> with_faces;
  for (const support::ContactPoint& point : support::rigid_blocks(scene).touching.points)
    with_faces.insert(std::minmax(point.one, point.other));
  for (int k = 0; k < scene.analysis.steps; ++k)
    if (!stepper.step()) throw Error(stepper.stop_reason());
  std::map<std::pair<int, int>, double> forces;
  double sum = 0;
  for (const ContactRecord& contact : stepper.contacts()) {
    if (contact.normal <= 0) continue;
    forces[std::minmax(contact.pair.vertex_block, contact.pair.edge_block)] += contact.normal;
    sum += contact.normal;
  }
  Hold hold{.slip = stepper.blocks().displacements(stepper.state()).colwise().norm().maxCoeff(),
            .unbalanced = stepper.equilibrium().unbalanced,
            .n_bearing = static_cast<int>(forces.size())};
  for (const auto& [pair, force] : forces) {
    if (with_faces.contains(pair)) continue;
    ++hold.n_new;
    hold.share += force / sum;
  }
  return hold;
}

/// The slopes of 20 to 60 blocks that come to rest although nothing could hold them.
void held_by_steps(Report& report) {
  std::vector<std::uint64_t> seeds;
  for (const SlopeResult& result : recorded())
    if (!is_large(result) && result.below.verdict != Verdict::moves) seeds.push_back(result.seed);
  if (seeds.empty()) return;
  constexpr double rounding = 0.01;
  report.paragraph(
      fmt::format("### What comes to rest below the limit\n\nThese slip by millimetres and are then held, in "
                  "balance, by blocks that met at the start in corners alone, or not at all. Where one joint "
                  "has slipped, the joints that cross it have steps of that height, and sharp corners do not "
                  "pass steps above the lip. The linear program knows the faces at the start; it is right of "
                  "the slope as it was cut, not of the one that has moved. Rounded corners "
                  "(`contact.corner_rounding = {:g}`) climb such steps.",
                  rounding));
  std::vector<std::vector<std::string>> rows{{"seed", "slip after 1 s", "unbalanced",
                                              "pairs of blocks that bear", "without a face at the start",
                                              "their part of the normal forces", "with rounded corners"}};
  Counts rounded;
  Slopes slopes({20, 60});
  for (const std::uint64_t seed : seeds) {
    Slope slope = slopes.next();
    while (slope.seed != seed) slope = slopes.next();
    const Hold hold = what_holds(slope);
    Scene scene = slope.scene;
    scene.contact.corner_rounding = rounding;
    const Outcome outcome = let_go(scene, below_limit * slope.limit, least_acceleration(slope.limit));
    rounded.add(Seen{outcome.verdict, outcome.part});
    rows.push_back({std::to_string(seed), fmt::format("{:.2g} mm", 1000 * hold.slip),
                    fmt::format("{:.0e}", hold.unbalanced), std::to_string(hold.n_bearing),
                    std::to_string(hold.n_new), fmt::format("{:.0f} %", 100 * hold.share),
                    text(Seen{outcome.verdict, outcome.part})});
  }
  report.table(rows);
  report.claims({{"With rounded corners these slopes move with 97 % of the friction that could hold them.",
                  rounded.all(Verdict::moves), rounded.text()}});
}

void slabs(Report& report) {
  report.paragraph(
      "### Slabs\n\nOne to four layers of up to eight blocks each on a plane, wider than what topples, so "
      "that every motion is "
      "sliding along it. With 97 % of tan(dip) they slide by a = g (sin − cos tan φ), with 103 % they rest.");
  std::vector<std::vector<std::string>> rows{
      {"seed", "free blocks", "dip", "97 %: acceleration over a", "103 %"}};
  Counts above;
  double worst = 0;
  for (std::uint64_t seed = 0; seed < n_slabs; ++seed) {
    const support::Slab slab = support::random_slab(seed);
    const double limit = std::tan(slab.dip), acceleration = least_acceleration(limit);
    const Outcome sliding = let_go(slab.scene, below_limit * limit, acceleration, 1),
                  resting = let_go(slab.scene, (2 - below_limit) * limit, acceleration);
    double error = 0;
    int n_free = 0;
    for (std::size_t b = 0; b < slab.scene.blocks.size(); ++b) {
      if (slab.scene.blocks[b].fixed) continue;
      ++n_free;
      const double way = sliding.vertices[b].rowwise().mean().norm();
      error = std::max(error, std::abs(2 * way / (acceleration * sliding.time * sliding.time) - 1));
    }
    worst = std::max(worst, error);
    above.add(Seen{resting.verdict, resting.part});
    rows.push_back({std::to_string(seed), std::to_string(n_free), fmt::format("{:.2f}°", degrees(limit)),
                    fmt::format("1 ± {:.1e}", error), text(Seen{resting.verdict, resting.part})});
  }
  report.table(rows);
  report.claims({{"Slabs slide by g (sin − cos tan φ), every block within 1 %.", worst <= slab_error,
                  fmt::format("{:.1e}", worst)},
                 {"Slabs rest with 103 % of tan(dip).", above.all(Verdict::rests), above.text()}});
}

}  // namespace

void random_slopes(Report& report) {
  report.heading("Random slopes");
  report.paragraph(fmt::format(
      "Slopes 20 m high, cut by two or three joint sets (`tests/support/random_slopes`), let go from rest "
      "under their weight, Δt = {} s. The limiting tan φ is the least at which admissible forces exist: a "
      "linear program of the static theorem, bisected. With less the slope has to move, whatever the law of "
      "flow. A single block on a plane of the limiting angle slides by a = {:.2f} g sin φ with 97 % of its "
      "tan φ. A slope moves when a vertex comes {:g} % as far as a takes that block in {} s, and rests when "
      "none comes a tenth of that. In brackets is the displacement over a t²/2. Above the limit a slope may "
      "slide nonetheless, since joints do not dilate by φ. It has to rest where φ is larger than every dip "
      "as well (120 % of the larger tangent): no block slides by its weight on any face.",
      time_step, 1 - below_limit, 100 * moving_part, watched));
  sample(report);
  all(report);
  held_by_steps(report);
  slabs(report);
}

}  // namespace jointed_rock
