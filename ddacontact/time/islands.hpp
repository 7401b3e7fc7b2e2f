/// \file Blocks that can pass impulses to one another.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/core/disjoint_sets.hpp>

#include <set>

namespace ddacontact {

/// Movable blocks joined to one another by contacts: islands, some of which take part in a jump of
/// velocities.
class Islands {
 public:
  explicit Islands(const BlockSystem& blocks) : blocks_(&blocks), sets_(blocks.n_blocks()) {}

  const BlockSystem& blocks() const { return *blocks_; }

  /// Both are of one island, if both are movable.
  void join(int a, int b);
  /// The block that stands for a block's island.
  int root(int b) const { return sets_.root(b); }
  /// The movable blocks on which a contact's form depends are of one island.
  void join(const AffineForm& form);
  /// Once all are joined: the form's island takes part.
  void hit(const AffineForm& form);
  bool is_hit(const AffineForm& form) const;
  /// The movable blocks of the islands that take part, ascending.
  std::vector<int> hit_blocks() const;

 private:
  int first_movable(const AffineForm& form) const;  ///< -1: none

  const BlockSystem* blocks_;
  DisjointSets sets_;  ///< of blocks
  std::set<int> hit_;  ///< roots
};

}  // namespace ddacontact
