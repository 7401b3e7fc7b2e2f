#include <ddacontact/solver/block_groups.hpp>
#include <tests/ddacontact/solver/random_blocks.hpp>

#include <gtest/gtest.h>

#include <set>

using namespace support;

namespace {

struct Grouped {
  RandomBlocks blocks;
  FrictionProblem problem;
  BlockGroups groups;

  Grouped(unsigned seed, int n_blocks, int n_contacts)
      : blocks(seed, n_blocks, n_contacts), problem(blocks.problem()) {
    EXPECT_TRUE(groups.set(problem, blocks.contacts));
  }
};

/// A few blocks, and more than two groups of them.
std::vector<Grouped> small_and_large() {
  std::vector<Grouped> all;
  for (unsigned seed = 0; seed < 20; ++seed) all.emplace_back(seed, 2 + static_cast<int>(seed), 30);
  all.emplace_back(20, 2 * BlockGroups::group_size + 900, 60000);
  return all;
}

/// Pairs of a block's unknowns that a contact moves with, those that are free.
std::size_t count_pairs(const BlockGroups& groups, const Range& unknowns, const ContactTerm& term) {
  std::set<int> pairs;
  for (int u : term.gap.unknowns()) {
    const int place = groups.place(u) - unknowns.first;
    if (groups.place(u) >= 0 && place >= 0 && place < unknowns.count) pairs.insert(place / 2);
  }
  return pairs.size();
}

}  // namespace

TEST(BlockGroups, EveryFreeUnknownHasAPlaceInOneBlockOfOneGroup) {
  for (const Grouped& g : small_and_large()) {
    int next = 0, next_unknown = 0;
    for (int group = 0; group < g.groups.n_groups(); ++group) {
      const Range blocks = g.groups.group(group);
      EXPECT_EQ(blocks.first, next);
      EXPECT_GT(blocks.count, 0);
      for (next = blocks.first; next < blocks.end(); ++next) {
        EXPECT_EQ(BlockGroups::group_of(next), group);
        EXPECT_EQ(g.groups.unknowns(next).first, next_unknown);
        next_unknown = g.groups.unknowns(next).end();
      }
    }
    EXPECT_EQ(next, g.groups.n_blocks());
    EXPECT_EQ(next_unknown, g.groups.n_unknowns());

    std::set<int> first_places;
    for (const std::vector<int>& unknowns : g.blocks.unknowns) {
      int first = -1;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        const int place = g.groups.place(unknowns[k]);
        EXPECT_EQ(place < 0, g.blocks.is_held(unknowns[k]));
        if (place < 0) continue;
        if (first < 0) first = place - static_cast<int>(k);
        EXPECT_EQ(place, first + static_cast<int>(k)) << "in the order of its matrix";
      }
      EXPECT_TRUE(first < 0 || first_places.insert(first).second);
    }
    EXPECT_EQ(static_cast<int>(first_places.size()), g.groups.n_blocks());
    for (int b = 0; b < g.groups.n_blocks(); ++b)
      EXPECT_TRUE(first_places.contains(g.groups.unknowns(b).first));
  }
}

TEST(BlockGroups, PackAndUnpackUndoEachOther) {
  for (Grouped& g : small_and_large()) {
    const VectorXd v = g.blocks.vector(g.blocks.n_unknowns());
    VectorXd packed, back, again;
    g.groups.pack(v, packed);
    ASSERT_EQ(packed.size(), g.groups.n_unknowns());
    g.groups.unpack(packed, back);
    g.groups.pack(back, again);
    EXPECT_EQ(again, packed);
    EXPECT_EQ(back, g.problem.free_part(v));
    for (Index u = 0; u < v.size(); ++u) {
      const int place = g.groups.place(static_cast<int>(u));
      EXPECT_TRUE(place < 0 || packed[place] == v[u]);
    }
  }
}

TEST(BlockGroups, NeighboursMirrorEachOther) {
  for (const Grouped& g : small_and_large()) {
    const BlockGroups& groups = g.groups;
    std::vector<int> seen(g.blocks.contacts.size(), 0);
    int index = 0;
    for (int b = 0; b < groups.n_blocks(); ++b) {
      EXPECT_EQ(groups.first_neighbour(b), index);
      int before = -1;
      for (const auto& [contact, block, back, n_entries] : groups.neighbours(b)) {
        EXPECT_GT(contact, before) << "ascending";
        before = contact;
        const auto c = static_cast<std::size_t>(contact);
        EXPECT_EQ(static_cast<std::size_t>(n_entries),
                  count_pairs(groups, groups.unknowns(b), g.blocks.contacts[c]));
        EXPECT_GT(n_entries, 0);
        ++seen[c];
        EXPECT_EQ(block < 0, back < 0);
        if (block >= 0) {
          const BlockGroups::Neighbour& there = groups.neighbour(back);
          EXPECT_EQ(there.contact, contact);
          EXPECT_EQ(there.block, b);
          EXPECT_EQ(there.back, index);
          EXPECT_GE(back, groups.first_neighbour(block));
          EXPECT_LT(back - groups.first_neighbour(block), std::ssize(groups.neighbours(block)));
        }
        ++index;
      }
    }
    EXPECT_EQ(groups.n_neighbours(), index);
    if (groups.n_groups() > 1) continue;
    for (std::size_t c = 0; c < seen.size(); ++c) {
      int n_blocks = 0;
      for (int b = 0; b < groups.n_blocks(); ++b)
        n_blocks += count_pairs(groups, groups.unknowns(b), g.blocks.contacts[c]) > 0;
      EXPECT_EQ(seen[c], n_blocks);
    }
  }
}

TEST(BlockGroups, FewContactsAreBetweenGroups) {
  const Grouped g(3, 2 * BlockGroups::group_size + 900, 60000);
  ASSERT_EQ(g.groups.n_groups(), 3);
  int between = 0;
  for (int b = 0; b < g.groups.n_blocks(); ++b)
    for (const BlockGroups::Neighbour& neighbour : g.groups.neighbours(b))
      if (neighbour.block >= 0 && BlockGroups::group_of(neighbour.block) != BlockGroups::group_of(b))
        ++between;
  EXPECT_GT(between, 0);
  EXPECT_LT(between, 200);
}

TEST(BlockGroups, CopiesMatricesWithTheIdentityWhereUnknownsAreHeld) {
  Grouped g(7, 12, 20);
  for (std::size_t e = 0; e < g.blocks.unknowns.size(); ++e) {
    const std::vector<int>& unknowns = g.blocks.unknowns[e];
    const auto n = static_cast<Index>(unknowns.size());
    const auto free =
        std::find_if_not(unknowns.begin(), unknowns.end(), [&](int u) { return g.blocks.is_held(u); });
    if (free == unknowns.end()) continue;
    int block = 0;
    while (g.groups.unknowns(block).end() <= g.groups.place(*free)) ++block;
    MatrixXd copy(n, n);
    Eigen::Map<MatrixXd> to(copy.data(), n, n);
    g.groups.copy_matrix(g.problem, block, to);
    for (Index k = 0; k < n; ++k)
      for (Index l = 0; l < n; ++l) {
        const bool held = g.blocks.is_held(unknowns[static_cast<std::size_t>(k)]) ||
                          g.blocks.is_held(unknowns[static_cast<std::size_t>(l)]);
        EXPECT_EQ(copy(k, l), !held ? g.blocks.matrices[e](k, l) : k == l ? 1 : 0);
      }
  }
}

TEST(BlockGroups, RefuseBlocksThatAreTooLargeOrOddOrShareUnknowns) {
  const auto accepts = [](const std::vector<std::vector<int>>& blocks, int n, bool last_held = false) {
    std::vector<int> equation(static_cast<std::size_t>(n));
    std::iota(equation.begin(), equation.end(), 0);
    if (last_held) equation.back() = -1;
    FrictionProblem problem(equation, last_held ? n - 1 : n);
    polyfem::Connectivity rows;
    for (const std::vector<int>& block : blocks) rows.append(block);
    problem.set_matrices(rows);
    BlockGroups groups;
    return groups.set(problem, {});
  };
  std::vector<int> numbers(18);
  std::iota(numbers.begin(), numbers.end(), 0);
  const auto first = [&](int n) { return std::vector(numbers.begin(), numbers.begin() + n); };
  EXPECT_TRUE(accepts({first(16)}, 16));
  EXPECT_FALSE(accepts({first(18)}, 18));
  EXPECT_FALSE(accepts({first(3)}, 3));
  EXPECT_FALSE(accepts({{0, 1}, {2, 1}}, 3));
  EXPECT_TRUE(accepts({{0, 2}, {1, 2}}, 3, true)) << "held ones may be shared";
}
