/// \file What a stage changes of the blocks at its start.
#include <ddacontact/time/stage.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

#include <algorithm>

using namespace support;

namespace {

/// Three blocks of 1 m x 1 m side by side, and a bolt from the first to the second.
struct ThreeBlocks {
  BuiltScene built = build(scene());
  BlockSystem& blocks = blocks_of(built);

  ThreeBlocks() {
    Bolt bolt;
    bolt.stiffness = 1;
    bolt.installed = false;
    for (const int b : {0, 1}) bolt.nodes.push_back({b, VectorXd::Unit(blocks.block(b).n_points(), 0)});
    blocks.set_bolts({bolt});
  }
  static Scene scene() {
    Scene scene = rock_scene(0.01, 1);
    for (int k = 0; k < 3; ++k) scene.blocks.push_back(block(rectangle(k, 0, 1, 1)));
    return scene;
  }
  void change(const Stage& stage, double start_time = 5) {
    change_blocks(stage, start_time, divide_faces(blocks), blocks);
  }
};

Stage some_stage() {
  return {{}, JointTable(JointStrength()), {}, false, {}, ""};
}
TimeFunction ramp(const Vec2& value) {
  return {TimeFunction::Kind::ramp, value, {}};
}

}  // namespace

TEST(Stage, TakesOutAndBringsInBlocks) {
  ThreeBlocks three;
  Stage first = some_stage(), second = some_stage();
  first.analysis.gravity = Vec2(1, -9);
  first.removed = {1};
  second.added = {2};
  remove_later({first, second}, three.blocks);
  EXPECT_FALSE(three.blocks.is_present(2));
  EXPECT_EQ(three.blocks.n_present(), 2);
  three.change(first);
  EXPECT_EQ(three.blocks.gravity, Vec2(1, -9));
  EXPECT_TRUE(three.blocks.is_present(0));
  EXPECT_FALSE(three.blocks.is_present(1));
  three.change(second);
  EXPECT_TRUE(three.blocks.is_present(2));
  EXPECT_EQ(three.blocks.n_present(), 2);
}

TEST(Stage, InstallsItsBoltsThatAreNotThereBefore) {
  ThreeBlocks three;
  three.blocks.bolts[0].installed = true;
  Stage without = some_stage(), with = some_stage();
  with.bolts = {0};
  remove_later({without, with}, three.blocks);
  EXPECT_FALSE(three.blocks.bolts[0].installed);
  three.change(without);
  EXPECT_FALSE(three.blocks.bolts[0].installed);
  three.change(with);
  EXPECT_TRUE(three.blocks.bolts[0].installed);
}

/// Ramps count from the start of the stage; what would act on a block that is gone is left out.
TEST(Stage, BringsItsLoadsOnTheBlocksThatAreThere) {
  ThreeBlocks three;
  three.blocks.end_time = 15;
  Stage stage = some_stage();
  EXPECT_FALSE(stage.has_new_loads());
  stage.removed = {1};
  for (const int b : {0, 1, 2}) {
    stage.point_loads.push_back(
        {{b, VectorXd::Unit(three.blocks.block(b).n_points(), 0)}, ramp({b + 1.0, 0})});
    EXPECT_TRUE(stage.has_new_loads());
    stage.pressure_loads.push_back({b, 2, ramp({b + 4.0, 0})});
    stage.body_loads.push_back({b, ramp({b + 7.0, 0})});
  }
  three.change(stage);
  ASSERT_EQ(three.blocks.point_loads.size(), 2u);
  ASSERT_EQ(three.blocks.pressure_loads.size(), 2u);
  ASSERT_EQ(three.blocks.body_loads.size(), 2u);
  const auto half_way = [&](const TimeFunction& load) { return load.at(10, 15).x(); };
  for (const std::size_t k : {0, 1}) {
    const int b = k == 0 ? 0 : 2;
    EXPECT_EQ(three.blocks.point_loads[k].point.block, b);
    EXPECT_DOUBLE_EQ(half_way(three.blocks.point_loads[k].force), (b + 1.0) / 2);
    EXPECT_EQ(three.blocks.pressure_loads[k].block, b);
    EXPECT_EQ(three.blocks.pressure_loads[k].edge, 2);
    EXPECT_DOUBLE_EQ(half_way(three.blocks.pressure_loads[k].pressure), (b + 4.0) / 2);
    EXPECT_EQ(three.blocks.body_loads[k].block, b);
    EXPECT_DOUBLE_EQ(half_way(three.blocks.body_loads[k].force), (b + 7.0) / 2);
  }
}

TEST(Stage, LoadsOfOtherKindsAreNewOnesToo) {
  Stage pressure = some_stage(), body = some_stage();
  pressure.pressure_loads.resize(1);
  body.body_loads.resize(1);
  EXPECT_TRUE(pressure.has_new_loads() && body.has_new_loads());
}

/// It reaches the faces of the blocks that are there, and goes with the stage.
TEST(Stage, WaterIsThatOfTheStage) {
  ThreeBlocks three;
  Stage dry = some_stage(), wet = some_stage();
  wet.water.table = Vec2(0, 3);
  wet.removed = {1};
  three.change(wet);
  EXPECT_EQ(three.blocks.water.water.table, wet.water.table);
  const std::vector<WetFace>& faces = three.blocks.water.faces;
  EXPECT_TRUE(std::ranges::none_of(faces, [](const WetFace& face) { return face.block == 1; }));
  for (const int b : {0, 2})
    EXPECT_EQ(std::ranges::count(faces, b, &WetFace::block), 4) << "all edges of block " << b;
  three.change(dry);
  EXPECT_FALSE(three.blocks.water.water.any());
  EXPECT_TRUE(three.blocks.water.faces.empty());
}
