// Bolts that come and go with stages.
#include <tests/ddacontact/time/bolted_scenes.hpp>

#include <ddacontact/scene/reader.hpp>

using namespace support;

TEST(Bolts, AreInstalledByAStageAndGoWithTheirBlocks) {
  Scene scene = hanging_block(0.01, 1);
  scene.blocks.push_back(block(rectangle(0, 3.5, 2, 1), true));  // it rests on this one at first
  scene.joints[0].friction_angle = 30;
  scene.materials[0].young = 1e10;
  scene.bolts[0].pretension = 10e3;
  StageDescription rest = scene.stage("rest"), bolted = scene.stage("bolted"), dug = scene.stage("dug"),
                   cut = scene.stage("cut");
  for (StageDescription* stage : {&rest, &bolted, &dug}) {
    stage->analysis.mode = Mode::statics;
    stage->analysis.time_step = 1;
    stage->analysis.steps = 20;
  }
  cut.analysis.steps = 10;
  bolted.bolts = {0};
  dug.removed = {2};
  cut.removed = {0};
  scene.stages = {rest, bolted, dug, cut};
  const BuiltScene built = build(scene);
  run(*built.stepper, 20);
  EXPECT_STREQ(view_of(*built.stepper).state(0), "absent");
  EXPECT_NEAR(closed_contacts(*built.stepper), weight, 1e-6 * weight);
  run(*built.stepper, 20);
  EXPECT_NEAR(axial(*built.stepper), 10e3, 1e-2 * 10e3);
  EXPECT_NEAR(closed_contacts(*built.stepper), weight - axial(*built.stepper), 1e-6 * weight);
  run(*built.stepper, 20);
  EXPECT_NEAR(axial(*built.stepper), weight, 1e-8 * weight);
  const double y = travel(*built.stepper, 1).y();
  run(*built.stepper, 10);
  EXPECT_NEAR(travel(*built.stepper, 1).y() - y, -0.05, 2e-3);  // it falls
  expect_closed(*built.stepper);
}

TEST(Bolts, PassAlongWhatTheyBearWhereABlockBetweenIsTakenOut) {
  Scene scene = grouted_pair();
  scene.blocks.push_back(block(rectangle(4, 0, 2, 1)));
  scene.bolts[0].to = {5.75, 0.5};
  scene.loads = {point_load(1, {3, 0.5}, constant({50e3, 0}))};
  StageDescription all = scene.stage("all"), two = scene.stage("two");
  two.removed = {2};
  scene.stages = {all, two};
  const BuiltScene built = run(scene);
  EXPECT_NEAR(axial(*built.stepper, at_joint(built.stepper->blocks().bolts[0])), 50e3, 1e-6 * 50e3);
  expect_closed(*built.stepper);
}

/// A bolt comes with the last of its blocks, without elongation.
TEST(Bolts, ComeInWithTheirBlocks) {
  const std::string_view text = R"(format = 1
[analysis]
mode = "static"
steps = 1
time_step = 1
gravity = [0, -10]
[[material]]
name = "rock"
density = 2000
young = 1e12
poisson = 0.25
[[block]]
name = "roof"
material = "rock"
fixed = true
vertices = [[0, 9.5], [2, 9.5], [2, 10.5], [0, 10.5]]
[[block]]
name = "late"
material = "rock"
vertices = [[0, 4.5], [2, 4.5], [2, 5.5], [0, 5.5]]
[[bolt]]
name = "b1"
points = [[1, 10], [1, 5]]
area = 4e-4
young = 2e11
[[stage]]
name = "before"
steps = 3
[[stage]]
name = "after"
steps = 40
add = ["late"]
)";
  const SceneReading reading = ddacontact::read_scene_text(std::string(text), "scene.toml", {});
  ASSERT_TRUE(reading.scene);
  EXPECT_EQ(reading.scene->stages.at(1).bolts, std::vector<int>{0});
  const BuiltScene built = build(*reading.scene);
  run(*built.stepper, 43);
  EXPECT_NEAR(axial(*built.stepper), weight, 1e-6 * weight);
  const SceneReading early =
      ddacontact::read_scene_text(std::string(text), "scene.toml", {"stage.0.add=[\"b1\"]"});
  ASSERT_EQ(early.problems.size(), 1u);
  EXPECT_NE(early.problems.front().what.find("comes in before block 'late'"), std::string::npos)
      << early.problems.front().what;
}
