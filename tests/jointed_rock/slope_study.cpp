#include "slope_study.hpp"

#include <tests/support/scene_changes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace jointed_rock {

namespace {

constexpr double steepest_tried = 80;  // degrees of friction

Seen seen(const Outcome& outcome) {
  return {outcome.verdict, outcome.part};
}

Restated restate(const Slope& slope, const Outcome& as_it_is) {
  const std::size_t n = slope.scene.blocks.size();
  std::vector<int> backwards;
  for (std::size_t b = 0; b < n; ++b) backwards.push_back(static_cast<int>(n - 1 - b));
  const auto moved = [&](const Scene& scene) {
    return let_go(scene, below_limit * slope.limit, least_acceleration(slope.limit));
  };
  const Mat2 mirror = (Mat2() << -1, 0, 0, 1).finished();
  const Outcome mirrored = moved(support::turned(slope.scene, mirror)),
                renumbered = moved(support::renumbered(support::reordered(slope.scene, backwards), 1));
  Restated found;
  for (const Outcome* other : {&mirrored, &renumbered})
    found.same_verdict = found.same_verdict && other->verdict == as_it_is.verdict;
  for (std::size_t b = 0; b < n; ++b) {
    const Points &here = as_it_is.vertices[b], &there = renumbered.vertices[n - 1 - b];
    for (Eigen::Index k = 0; k < here.cols(); ++k)
      found.apart = std::max({found.apart, (mirror * mirrored.vertices[b].col(k) - here.col(k)).norm(),
                              (there.col((k + 1) % here.cols()) - here.col(k)).norm()});
  }
  found.apart /= as_it_is.displacement;
  return found;
}

}  // namespace

double degrees(double tangent) {
  return std::atan(tangent) * 180 / std::numbers::pi;
}

double least_acceleration(double limit) {
  return (1 - below_limit) * gravity * std::sin(std::atan(limit));
}

Slope Slopes::next() {
  while (true) {
    Slope slope;
    slope.seed = seed_++;
    slope.scene = support::random_slope(slope.seed, size_);
    const support::RigidBlocks blocks = support::rigid_blocks(slope.scene);
    const std::optional<double> limit = support::least_friction(blocks);
    n_never_held_ += !limit;
    // Tangents at corners are chosen for each friction anew: that less does not hold is checked directly.
    if (!limit || *limit == 0 || support::can_be_held(blocks, below_limit * *limit)) continue;
    slope.n_free = static_cast<int>(std::count(blocks.fixed.begin(), blocks.fixed.end(), false));
    slope.limit = *limit;
    slope.steepest = std::tan(support::steepest_dip(blocks));
    return slope;
  }
}

SlopeResult study(const Slope& slope, bool with_restated) {
  SlopeResult result;
  result.seed = slope.seed;
  result.n_free = slope.n_free;
  result.limit = slope.limit;
  result.steepest = slope.steepest;
  const auto with = [&](double friction) {
    return let_go(slope.scene, friction, least_acceleration(slope.limit));
  };
  const Outcome below = with(below_limit * slope.limit);
  result.below = seen(below);
  if (with_restated) result.restated = restate(slope, below);
  result.above = seen(with(above_limit * slope.limit));
  const double rough = above_both * std::max(slope.limit, slope.steepest);
  if (degrees(rough) <= steepest_tried) result.rough = seen(with(rough));
  return result;
}

std::string record_line(const SlopeResult& result) {
  const auto text = [](const std::optional<Seen>& of) {
    return of ? fmt::format("{},{:.3g}", name_of(of->verdict), of->part) : ",";
  };
  return fmt::format(
      "{},{},{:.9g},{:.9g},{},{},{},{}", result.seed, result.n_free, result.limit, result.steepest,
      text(result.below), text(result.above), text(result.rough),
      result.restated
          ? fmt::format("{},{:.2g}", result.restated->same_verdict ? "same" : "other", result.restated->apart)
          : ",");
}

SlopeResult read_record_line(const std::string& line) {
  std::istringstream in(line + ",");
  std::array<std::string, 12> entries;
  for (std::string& entry : entries)
    if (!std::getline(in, entry, ',')) throw Error("not a record of a slope: " + line);
  const auto seen_at = [&](std::size_t k) -> std::optional<Seen> {
    if (entries[k].empty()) return std::nullopt;
    for (const Verdict verdict : {Verdict::moves, Verdict::creeps, Verdict::rests, Verdict::stops})
      if (entries[k] == name_of(verdict)) return Seen{verdict, std::stod(entries[k + 1])};
    throw Error("not a record of a slope: " + line);
  };
  SlopeResult result;
  result.seed = std::stoull(entries[0]);
  result.n_free = std::stoi(entries[1]);
  result.limit = std::stod(entries[2]);
  result.steepest = std::stod(entries[3]);
  result.below = seen_at(4).value();
  result.above = seen_at(6).value();
  result.rough = seen_at(8);
  if (!entries[10].empty()) result.restated = Restated{entries[10] == "same", std::stod(entries[11])};
  return result;
}

}  // namespace jointed_rock
