#include <ddacontact/time/sleeping.hpp>

#include <ddacontact/core/disjoint_sets.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/time/waves.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

/// Part of the velocity that gravity makes in a step.
constexpr double slow = 5e-8;
/// Of those awake at least this part falls asleep at once: every change costs what all of them cost.
constexpr double worth_while = 0.125;

double rest_speed(const BlockSystem& blocks, int b, double dt, const RayleighDamping& damping) {
  assert(dt > 0);
  double time = dt;
  if (damping.mass > 0) time = std::min(time, 1 / damping.mass);
  if (damping.stiffness > 0)
    time = std::min(time, std::pow(transit_time(blocks.block(b)), 2) / damping.stiffness);
  return std::max(slow * blocks.gravity.norm() * time, length_round_off * blocks.block(b).size() / dt);
}

Sleeping::Sleeping(const SleepRecord& record)
    : island_(record.island),
      rested_(record.rested),
      n_asleep_(static_cast<int>(std::ranges::count_if(island_, [](int island) { return island != 0; }))) {}

std::vector<int> Sleeping::put_to_sleep(const std::vector<int>& awake, std::span<const Pair> touching) {
  const auto has_rested = [&](int b) { return rested_[b] == enough; };
  const double least = worth_while * static_cast<double>(awake.size());
  const auto n_rested = std::ranges::count_if(awake, has_rested);
  if (n_rested == 0 || static_cast<double>(n_rested) < least) return {};
  const auto number = [&](int b) {
    return static_cast<int>(std::ranges::lower_bound(awake, b) - awake.begin());
  };
  DisjointSets islands(static_cast<int>(awake.size()));
  for (const auto& [a, b] : touching) islands.join(number(a), number(b));
  std::vector<char> at_rest(awake.size(), 1);
  for (int k = 0; k < static_cast<int>(awake.size()); ++k)
    if (!has_rested(awake[k])) at_rest[islands.root(k)] = 0;
  std::vector<int> falling;
  for (int k = 0; k < static_cast<int>(awake.size()); ++k)
    if (at_rest[islands.root(k)]) falling.push_back(awake[k]);
  if (falling.empty() || static_cast<double>(falling.size()) < least) return {};
  for (int b : falling) island_[b] = 1 + awake[islands.root(number(b))];
  n_asleep_ += static_cast<int>(falling.size());
  return falling;
}

bool Sleeping::wake(int b) {
  const int island = island_[b];
  if (island == 0) return false;
  for (std::size_t k = 0; k < island_.size(); ++k)
    if (island_[k] == island) {
      island_[k] = rested_[k] = 0;
      --n_asleep_;
    }
  return true;
}

void Sleeping::wake_all() {
  std::ranges::fill(island_, 0);
  std::ranges::fill(rested_, 0);
  n_asleep_ = 0;
}

}  // namespace ddacontact
