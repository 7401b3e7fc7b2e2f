/// \file Scenes that `dda make` writes are valid whatever their measures.
#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/made_scenes.hpp>
#include <ddacontact/scene/reader.hpp>

#include <polyfem/geometry/area_moments.hpp>

#include "example_scenes.hpp"

#include <algorithm>

namespace {

using namespace ddacontact;
using example_scenes::all_text;

Scene valid(const std::string& text) {
  const SceneReading reading = read_scene_text(text, "made.toml");
  EXPECT_TRUE(reading.scene) << all_text(reading.problems);
  EXPECT_TRUE(reading.problems.empty()) << all_text(reading.problems);
  return reading.scene.value_or(Scene());
}

TEST(MadeScenes, AreSoundWithDefaults) {
  EXPECT_GT(valid(made_scene(MadeSlope{})).blocks.size(), 100u);
  const Scene tunnel = valid(made_scene(MadeTunnel{}));
  EXPECT_GT(tunnel.blocks.size(), 100u);
  EXPECT_GT(tunnel.stages.at(2).removed.size(), 2u);
  EXPECT_EQ(valid(made_scene(MadeArch{})).blocks.size(), 17u);
  EXPECT_EQ(valid(made_scene(MadeColumn{})).blocks.size(), 9u);
  EXPECT_EQ(valid(made_scene(MadeHeap{})).blocks.size(), 63u);
  const Scene wall = valid(made_scene(MadeWall{}));
  EXPECT_EQ(std::ranges::count(wall.blocks, "lintel", &BlockDescription::name), 1);
}

TEST(MadeScenes, AreSoundForOtherMeasures) {
  for (const double face : {40., 75., 90.})
    for (const double dip : {-30., 0., 50.})
      valid(made_scene(MadeSlope{.height = 12, .face = face, .dip = dip, .spacing = 1.7, .seed = 3}));
  valid(made_scene(MadeTunnel{.width = 4, .height = 2, .spacing = 1.5, .seed = 2}));
  valid(made_scene(MadeWall{.door_width = 0, .running_bond = false}));
  valid(made_scene(MadeArch{.span = 3, .thickness = 0.2, .voussoirs = 7, .fill = true}));
  valid(made_scene(MadeHeap{.size = 2, .blocks = 1}));
}

TEST(MadeScenes, RefuseMeasuresOfNoWallAndOfTooManyBricks) {
  EXPECT_THROW(made_scene(MadeWall{.brick_length = 1e-6, .brick_height = 1e-6}), Error);
  EXPECT_THROW(made_scene(MadeArch{.voussoirs = 600000, .fill = true}), Error);
  EXPECT_THROW(made_scene(MadeWall{.length = 0.3}), Error);
  EXPECT_THROW(made_scene(MadeWall{.door_width = 5.9}), Error);
  valid(made_scene(MadeWall{.door_width = 5.25}));
  EXPECT_THROW(made_scene(MadeWall{.height = 2, .door_height = 2}), Error);
  valid(made_scene(MadeWall{.length = 0.3, .door_width = 0}));
}

TEST(MadeScenes, BricksFillTheWallButForItsDoor) {
  double area = 0;
  for (const BlockDescription& block : valid(made_scene(MadeWall{})).blocks)
    if (!block.fixed) area += polyfem::signed_area(block.vertices);
  EXPECT_NEAR(area, 6 * 3 - 1.25 * 1.75, 1e-12);
}

TEST(MadeScenes, ContactsOfTheSlopeFollowItsBedding) {
  const Scene slope = valid(made_scene(MadeSlope{}));
  const int bedding = 1;
  const auto has_bedding = [&](const BlockDescription& block) {
    return std::ranges::count(block.edge_joints, bedding) > 0;
  };
  EXPECT_EQ(slope.joints[bedding].name, "bedding");
  EXPECT_GT(std::ranges::count_if(slope.blocks, has_bedding), 100);
}

}  // namespace
