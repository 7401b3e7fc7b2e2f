#include "changes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace stability {

namespace {

constexpr int n_shakes = 4;

Restatement units(const std::string& name, const support::Units& by) {
  return {name, [by](const Scene& scene) { return support::scaled(scene, by); },
          [by](Run run) {
            const double stress = by.mass / by.time / by.time;
            for (Points& of_block : run.displacements) of_block /= by.length;
            run.stress /= stress;
            run.reactions /= stress * by.length;
            run.time /= by.time;
            return run;
          }};
}

Restatement view(const std::string& name, const Mat2& by) {
  return {name, [by](const Scene& scene) { return support::turned(scene, by); },
          [by](Run run) {
            for (Points& of_block : run.displacements) of_block = (by.transpose() * of_block).eval();
            return run;
          }};
}

Restatement numbers(const std::string& name, int shift, bool other_way) {
  return {name, [=](const Scene& scene) { return support::renumbered(scene, shift, other_way); },
          [=](Run run) {
            for (Points& of_block : run.displacements) {
              const Points renumbered = of_block;
              const Index n = of_block.cols();
              for (Index k = 0; k < n; ++k) {
                const Index moved_on = (k + shift) % n;
                of_block.col(k) = renumbered.col(other_way ? n - 1 - moved_on : moved_on);
              }
            }
            return run;
          }};
}

/// The place of each block when they are dealt out by lot; seed 0: in the opposite order.
std::vector<int> order_of_blocks(std::size_t n, unsigned seed) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  if (seed == 0)
    std::reverse(order.begin(), order.end());
  else
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  return order;
}

Restatement blocks(const std::string& name, unsigned seed) {
  return {name,
          [seed](const Scene& scene) {
            return support::reordered(scene, order_of_blocks(scene.blocks.size(), seed));
          },
          [seed](Run run) {
            const std::vector<Points> reordered = run.displacements;
            const std::vector<int> order = order_of_blocks(reordered.size(), seed);
            for (std::size_t b = 0; b < order.size(); ++b)
              run.displacements[b] = reordered[static_cast<std::size_t>(order[b])];
            return run;
          }};
}

}  // namespace

std::vector<Restatement> binary_units() {
  return {units("2^10 m", {1024, 1, 1}), units("2^-6 m", {1. / 64, 1, 1}), units("2^20 kg", {1, 1 << 20, 1}),
          units("2^-8 s", {1, 1, 1. / 256}),
          units("2^-20 m, 2^10 kg, 2^8 s", {std::ldexp(1, -20), 1024, 256})};
}

std::vector<Restatement> decimal_units() {
  std::vector<Restatement> all;
  for (const double by : {1e6, 1e-6}) {
    all.push_back(units(fmt::format("{:g} m", by), {by, 1, 1}));
    all.push_back(units(fmt::format("{:g} kg", by), {1, by, 1}));
    all.push_back(units(fmt::format("{:g} s", by), {1, 1, by}));
    all.push_back(units(fmt::format("{:g} m, {:g} kg, {:g} s", by, 1 / by, by), {by, 1 / by, by}));
  }
  return all;
}

std::vector<Restatement> other_views() {
  Mat2 quarter, mirror;
  quarter << 0, -1, 1, 0;
  mirror << -1, 0, 0, 1;
  const Mat2 small = Eigen::Rotation2Dd(0.3).toRotationMatrix(),
             large = Eigen::Rotation2Dd(2).toRotationMatrix();
  return {view("turned by 90 degrees", quarter),
          view("turned by 180 degrees", -Mat2::Identity()),
          view("turned by 0.3 rad", small),
          view("turned by 2 rad", large),
          view("mirrored", mirror),
          view("mirrored and turned", mirror * large),
          numbers("vertices from the next on", 1, false),
          numbers("vertices the other way round", 2, true),
          blocks("blocks in the opposite order", 0),
          blocks("blocks in a random order", 3)};
}

Agreement compare(const NamedScene& named, const std::vector<Restatement>& restatements, int steps) {
  const Run base = run_to_end(named.scene, steps);
  const double size = smallest_size(named.scene);
  Agreement agreement{named.name, 0, "", 0, true};
  for (const Restatement& restatement : restatements) {
    const Run other = restatement.read_back(run_to_end(restatement.restated(named.scene), steps));
    const double apart = distance(base, other) / size;
    agreement.same_counts = agreement.same_counts && same_counts(base, other);
    if (apart <= agreement.apart) continue;
    agreement.apart = apart;
    agreement.worst = restatement.name;
  }
  for (unsigned seed = 1; seed <= n_shakes; ++seed)
    agreement.shaken = std::max(agreement.shaken,
                                distance(base, run_to_end(support::shaken(named.scene, seed), steps)) / size);
  return agreement;
}

bool same_bits(const Run& one, const Run& other) {
  return distance(one, other) == 0 && one.stress == other.stress && one.reactions == other.reactions &&
         one.time == other.time && same_counts(one, other);
}

}  // namespace stability
