/// \file Numbers in sets that are joined: blocks that touch make islands.
#pragma once

#include <numeric>
#include <vector>

namespace ddacontact {

/// 0 .. n - 1, each a set of its own at first.
class DisjointSets {
 public:
  explicit DisjointSets(int n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The number that stands for the set of k: the same for all of a set.
  int root(int k) const {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  /// The sets of a and b become one; b's root stands for it.
  void join(int a, int b) { parent_[root(a)] = root(b); }

 private:
  mutable std::vector<int> parent_;  ///< towards the root; `root` shortens the way
};

}  // namespace ddacontact
