// Structures are at their limit as they are drawn, whatever the seed, and carry less.
#include "random_arches_walls.hpp"

#include "limit_analysis.hpp"
#include "overlap_area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace support;

class RandomMasonryTest : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Kinds, RandomMasonryTest, testing::Range(0, n_masonry_kinds));

TEST_P(RandomMasonryTest, CarriesItsLoadUpToTheLimitWithAnyMoreFriction) {
  for (int k = 0; k < 25; ++k) {
    const LoadedMasonry masonry =
        random_masonry(static_cast<std::uint64_t>(n_masonry_kinds * k + GetParam()));
    EXPECT_EQ(masonry.kind, static_cast<Masonry>(GetParam()));
    for (const double factor : {0.5, 1., 2.}) {
      const RigidBlocks blocks = rigid_blocks(loaded(masonry, factor));
      EXPECT_NEAR(*largest_factor(blocks, masonry.friction), 1 / factor, 1e-6);
      EXPECT_LE(*largest_factor(blocks, 10 * masonry.friction), 1.00101 / factor);
    }
    EXPECT_TRUE(can_be_held(rigid_blocks(masonry.scene), masonry.friction)) << "without the load";
  }
}

TEST_P(RandomMasonryTest, BlocksDoNotOverlapAndDifferFromSeedToSeed) {
  std::set<std::size_t> sizes;
  for (int k = 0; k < 25; ++k) {
    const auto scene = random_masonry(static_cast<std::uint64_t>(n_masonry_kinds * k + GetParam())).scene;
    sizes.insert(scene.blocks.size());
    for (std::size_t b = 0; b < scene.blocks.size(); ++b)
      for (std::size_t other = 0; other < b; ++other)
        EXPECT_LT(overlap_area_of_convex(scene.blocks[b].vertices, scene.blocks[other].vertices), 1e-12);
  }
  EXPECT_GE(sizes.size(), 4u);
}
