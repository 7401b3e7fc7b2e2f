/// \file Which blocks sleep: islands at rest, left alone until something reaches them.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/core/options.hpp>
#include <ddacontact/detection/broad_phase.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace ddacontact {

/// State of the sleeping mechanism that a checkpoint stores.
struct SleepRecord {
  std::vector<int> island;  ///< of each block that sleeps, > 0; 0: it is awake
  std::vector<int> rested;  ///< of each block: substeps in a row that it was at rest in
  /// Boxes of the blocks that are awake and can move, ascending: a block may move within its own until its
  /// neighbours are looked for again. Empty while nobody sleeps.
  std::vector<Box> around;
};

/// A block is at rest while it is slower than this: what the residuals of steps leave of the velocity that
/// gravity makes in one of them, or in the shorter time that damping leaves it, under which blocks creep; or
/// round-off of the block's size, m/s.
double rest_speed(const BlockSystem& blocks, int b, double dt, const RayleighDamping& damping);

/// Blocks by the islands they sleep in.
///
/// An island is what closed contacts connect, held blocks aside. It falls asleep when all its blocks have
/// been at rest for `enough` substeps in a row, and wakes as a whole.
class Sleeping {
 public:
  static constexpr int enough = 10;

  explicit Sleeping(int n_blocks) : island_(n_blocks, 0), rested_(n_blocks, 0) {}
  explicit Sleeping(const SleepRecord& record);

  bool is_asleep(int b) const { return island_[b] != 0; }
  int n_asleep() const { return n_asleep_; }

  /// Notes whether a block that is awake was at rest in the substep just made.
  void note(int b, bool at_rest) { rested_[b] = at_rest ? std::min(rested_[b] + 1, enough) : 0; }
  /// Puts the islands to sleep that have rested enough, if they are a part of those awake that is worth the
  /// change: then returns their blocks.
  /// \param[in] awake     movable blocks, ascending
  /// \param[in] touching  pairs of them
  std::vector<int> put_to_sleep(const std::vector<int>& awake, std::span<const Pair> touching);
  /// Wakes the island of a block; false: it was awake.
  bool wake(int b);
  void wake_all();

  const std::vector<int>& islands() const { return island_; }
  const std::vector<int>& rested() const { return rested_; }

 private:
  std::vector<int> island_, rested_;
  int n_asleep_ = 0;
};

}  // namespace ddacontact
