#include <ddacontact/core/disjoint_sets.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

using ddacontact::DisjointSets;

TEST(DisjointSets, EachNumberIsASetOfItsOwnAtFirst) {
  const DisjointSets sets(4);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(sets.root(k), k);
}

TEST(DisjointSets, TheRootOfTheSecondStandsForBoth) {
  DisjointSets sets(6);
  sets.join(0, 1);
  sets.join(2, 3);
  sets.join(0, 2);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(sets.root(k), 3);
  EXPECT_EQ(sets.root(4), 4);
  sets.join(1, 3);  // they are one already
  EXPECT_EQ(sets.root(0), 3);
}

/// Numbers have the same root where pairs that were joined lead from one to the other.
TEST(DisjointSets, AreThoseOfThePairsThatWereJoined) {
  std::mt19937 random(1);
  constexpr int n = 40;
  DisjointSets sets(n);
  std::vector<int> label(n);
  for (int k = 0; k < n; ++k) label[k] = k;
  for (int joins = 0; joins < n; ++joins) {
    const auto a = random() % n, b = random() % n;
    sets.join(static_cast<int>(a), static_cast<int>(b));
    const int old = label[a], now = label[b];
    for (int& of : label)
      if (of == old) of = now;
    for (int k = 0; k < n; ++k)
      for (int l = 0; l < n; ++l) ASSERT_EQ(sets.root(k) == sets.root(l), label[k] == label[l]);
  }
}
