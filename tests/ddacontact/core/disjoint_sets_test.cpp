#include <ddacontact/core/disjoint_sets.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

using ddacontact::DisjointSets;

/// Numbers have the same root where pairs that were joined lead from one to the other: that of the second.
TEST(DisjointSets, AreThoseOfThePairsThatWereJoined) {
  std::mt19937 random(1);
  constexpr int n = 40;
  DisjointSets sets(n);
  std::vector<int> label(n);
  for (int k = 0; k < n; ++k) label[k] = k;
  for (int joins = 0; joins < n; ++joins) {
    const auto a = random() % n, b = random() % n;
    const int root = sets.root(static_cast<int>(b));
    sets.join(static_cast<int>(a), static_cast<int>(b));
    ASSERT_EQ(sets.root(static_cast<int>(a)), root);
    const int old = label[a], now = label[b];
    for (int& of : label)
      if (of == old) of = now;
    for (int k = 0; k < n; ++k)
      for (int l = 0; l < n; ++l) ASSERT_EQ(sets.root(k) == sets.root(l), label[k] == label[l]);
  }
}
