#include <ddacontact/block/bolt.hpp>
#include <ddacontact/equations/bolt_law.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// A held and two free blocks far from the origin, with a bar between their middles, 3 m and 4 m, then 5 m.
struct BarOfTwo {
  BuiltScene built;
  BlockState state;

  explicit BarOfTwo(bool grouted = false) : built(build(scene())) {
    BlockSystem& blocks = blocks_of(built);
    Bolt bar;
    for (const int b : {0, 1, 2}) bar.nodes.push_back({b, VectorXd::Constant(4, 0.25)});
    bar.stiffness = 6e6;
    bar.pretension = 9e3;
    if (grouted) bar.bonded = {1, 1, 1};
    blocks.set_bolts({bar, bar});
    state = blocks.initial_state();
  }
  static Scene scene() {
    Scene scene = rock_scene(0.1, 1);
    scene.blocks = {block(rectangle(1e5, 0, 1, 1), true), block(rectangle(1e5 + 3, 0, 1, 1)),
                    block(rectangle(1e5 + 6, 4, 1, 1))};
    return scene;
  }
  BlockSystem& blocks() { return blocks_of(built); }
  Bolt& bolt() { return blocks().bolts[1]; }
};

}  // namespace

TEST(Bolt, SegmentsLeadFromNodeToNode) {
  BarOfTwo bar;
  EXPECT_LE((segment_vector(bar.bolt(), 0, bar.blocks(), bar.state) - Vec2(3, 0)).norm(), 1e-11);
  EXPECT_LE((segment_vector(bar.bolt(), 1, bar.blocks(), bar.state) - Vec2(3, 4)).norm(), 1e-11);
}

TEST(Bolt, InstalledItBearsItsPretensionAndNoElongation) {
  for (const bool grouted : {false, true}) {
    BarOfTwo bar(grouted);
    bar.state.bolts.setConstant(-1);
    install(bar.bolt(), bar.blocks(), bar.state);
    EXPECT_TRUE((bar.state.bolts.head(bar.bolt().numbers.first).array() == -1).all()) << "the other bolt";
    EXPECT_LE(elongations(bar.bolt(), bar.blocks(), bar.state).norm(), 1e-15);
    const VectorXd numbers = bar.state.bolts.segment(bar.bolt().numbers.first, bar.bolt().numbers.count);
    EXPECT_NEAR(numbers[Bolt::length(1)], 5, 1e-10);
    EXPECT_EQ(numbers[Bolt::torn(1)], 0);
    const VectorXd axial = bolt_forces(bar.bolt(), numbers, VectorXd::Zero(2)).axial;
    if (!grouted) {
      EXPECT_LE((axial.array() - 9e3).abs().maxCoeff(), 1e-8);
    }
    bar.state.position.middleCols<4>(8).colwise() += Vec2(0.6, 0.8);
    const VectorXd longer = elongations(bar.bolt(), bar.blocks(), bar.state);
    EXPECT_LE((longer - Eigen::Vector2d(0, 1)).norm(), 1e-11);
  }
}

TEST(Bolt, OfABlockThatIsGoneKeepsItsOtherSegments) {
  BarOfTwo bar;
  bar.bolt().nodes[0].block = -1;
  install(bar.bolt(), bar.blocks(), bar.state);
  EXPECT_EQ(bar.state.bolts[bar.bolt().numbers.first + Bolt::length(0)], 0);
  bar.state.position.middleCols<4>(8).colwise() += Vec2(0.6, 0.8);
  EXPECT_LE((elongations(bar.bolt(), bar.blocks(), bar.state) - Eigen::Vector2d(0, 1)).norm(), 1e-11);
}

TEST(Bolt, ActsWhereASegmentOfItMayMove) {
  BarOfTwo bar;
  EXPECT_TRUE(acts(bar.bolt(), bar.blocks()));
  bar.bolt().installed = false;
  EXPECT_FALSE(acts(bar.bolt(), bar.blocks()));
  bar.bolt().installed = true;
  bar.bolt().nodes[2].block = -1;
  EXPECT_TRUE(acts(bar.bolt(), bar.blocks())) << "its second node moves";
  bar.bolt().nodes[1].block = 0;
  EXPECT_FALSE(acts(bar.bolt(), bar.blocks())) << "both ends are held";
  bar.bolt().nodes[1].block = -1;
  EXPECT_FALSE(acts(bar.bolt(), bar.blocks())) << "no segment is left";
}
