// Stages that end when they have come to rest.
#include <tests/ddacontact/simple_scenes.hpp>

#include <ddacontact/output/run_verdict.hpp>

#include <algorithm>

using namespace support;

namespace {

/// A block, dropped by `drop` onto a fixed ground; then it is pushed.
Scene drop_scene(Mode mode, double drop, int steps, const RestCriterion& until) {
  Scene scene;
  scene.analysis.time_step = 0.01;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"stone", 2500, 1e9, 0.2}};
  scene.joints = {{"joint", 30, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40e9;
  scene.contact.tangential_stiffness = 16e9;
  scene.blocks = {block(rectangle(-5, -1, 30, 1), true), block(rectangle(0, drop, 2, 1))};
  scene.blocks[1].name = "falls";
  StageDescription settle = scene.stage("settle"), push = scene.stage("push");
  settle.analysis.mode = mode;
  settle.analysis.steps = steps;
  settle.until = until;
  push.analysis.steps = 10;
  push.analysis.gravity = Vec2(9.8, -9.8);
  scene.stages = {settle, push};
  return scene;
}

const RestCriterion at_rest{.kinetic = 1e-8, .displacement = 1e-6};

}  // namespace

TEST(Until, EndsAStageWithTheFirstStepAtRest) {
  for (const Mode mode : {Mode::dynamic, Mode::statics}) {
    const BuiltScene built = build(drop_scene(mode, mode == Mode::statics ? 0 : 0.01, 1000, at_rest));
    Stepper& stepper = *built.stepper;
    while (stepper.stage() == 0) {
      EXPECT_TRUE(stepper.stage_ends().empty());
      run(stepper, 1);
      ASSERT_LT(stepper.counts().steps, 1000);
    }
    ASSERT_EQ(stepper.stage_ends().size(), 1u);
    const StageEnd& settled = stepper.stage_ends()[0];
    EXPECT_TRUE(settled.came_to_rest);
    EXPECT_TRUE(settled.at_rest);
    EXPECT_EQ(settled.steps, stepper.counts().steps - 1);
    EXPECT_GT(settled.steps, 1) << "the first step has not settled yet";
    EXPECT_LE(settled.equilibrium.kinetic, 1e-8 * settled.exchanged);
    EXPECT_LE(settled.equilibrium.relative_speed, 1e-6);
    EXPECT_NEAR(stepper.state().time, 0.01 * static_cast<double>(stepper.counts().steps), 1e-12);
    run(stepper, 9);
    EXPECT_FALSE(stepper.is_at_rest());
    EXPECT_FALSE(stepper.is_over()) << "the last stage has no 'until'";
    EXPECT_TRUE(warnings_of(stepper).empty()) << warnings_of(stepper).front();
  }
}

TEST(Until, EachConditionByItselfIsMet) {
  for (const RestCriterion& until : {RestCriterion{1e-8, std::nullopt}, RestCriterion{std::nullopt, 1e-6}}) {
    const BuiltScene built = build(drop_scene(Mode::dynamic, 0.01, 1000, until));
    while (built.stepper->stage() == 0) run(*built.stepper, 1);
    EXPECT_TRUE(built.stepper->stage_ends().at(0).came_to_rest);
    EXPECT_LT(built.stepper->stage_ends().at(0).steps, 1000);
  }
}

TEST(Until, FallingNeverEndsAStageHoweverShortItsSteps) {
  for (const Mode mode : {Mode::dynamic, Mode::statics}) {
    Scene scene = drop_scene(mode, 10, 20, at_rest);
    scene.stages[0].analysis.time_step = 1e-6;
    const BuiltScene built = build(scene);
    run(*built.stepper, 21);
    ASSERT_EQ(built.stepper->stage_ends().size(), 1u);
    EXPECT_FALSE(built.stepper->stage_ends()[0].came_to_rest);
    EXPECT_EQ(built.stepper->stage_ends()[0].steps, 20);
    const std::vector<std::string> warnings = warnings_of(*built.stepper);
    ASSERT_EQ(warnings.size(), 1u);
    for (const char* word :
         {"stage \"settle\"", "20 steps", "'until' never came true", "\"falls\"", "(more 'steps'"})
      EXPECT_NE(warnings[0].find(word), std::string::npos) << warnings[0];
  }
}

/// Static steps that something falls in are no equilibrium for the next stage to begin with.
TEST(Until, AStaticStageThatEndsOutOfBalanceIsToldOf) {
  Scene scene = drop_scene(Mode::statics, 0.01, 3, at_rest);
  scene.stages[0].until.reset();
  const BuiltScene built = build(scene);
  run(*built.stepper, 4);
  const std::vector<std::string> warnings = warnings_of(*built.stepper);
  EXPECT_EQ(
      std::ranges::count_if(warnings,
                            [](const std::string& warning) {
                              return warning.find("stage \"settle\" ended before it was in equilibrium") !=
                                     std::string::npos;
                            }),
      1);
}

TEST(Until, OfTheLastStageEndsTheRun) {
  Scene scene = drop_scene(Mode::statics, 0, 1000, at_rest);
  scene.stages.pop_back();
  const BuiltScene built = build(scene);
  int steps = 0;
  for (; !built.stepper->is_over(); ++steps) run(*built.stepper, 1);
  EXPECT_LT(steps, 100);
  EXPECT_TRUE(built.stepper->stage_ends().empty()) << "the last stage has not been left";
  EXPECT_TRUE(built.stepper->stage_end().came_to_rest);
  EXPECT_TRUE(warnings_of(*built.stepper).empty());
}

/// However slowly it grows: a stage that ended by itself within the ramp would call the block at rest under a
/// part of the load that overturns it.
TEST(Until, IsNotMetWhileALoadGrows) {
  Scene scene = drop_scene(Mode::statics, 0, 600, at_rest);
  scene.analysis.time_step = scene.stages[0].analysis.time_step = 0.05;
  ddacontact::Load load;
  load.kind = ddacontact::Load::Kind::body;
  load.block = 1;
  load.force.value = Vec2(1e3, 0);
  load.force.rise = 20;
  scene.loads = {load};
  scene.stages[0].loads = {0};
  const BuiltScene built = build(scene);
  while (built.stepper->stage_ends().empty()) run(*built.stepper, 1);
  EXPECT_TRUE(built.stepper->stage_ends()[0].came_to_rest);
  EXPECT_GE(built.stepper->stage_ends()[0].time, 20);
  EXPECT_LT(built.stepper->stage_ends()[0].time, 20.5);

  scene.stages = {scene.stages[0]};
  scene.stages[0].analysis.steps = 100;
  const BuiltScene shorter = build(scene);
  run(*shorter.stepper, 100);
  const std::vector<std::string> warnings = warnings_of(*shorter.stepper);
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& text) {
    return text.find("never came true: a load, a support or the ground changes until t = 20 s") != text.npos;
  }));
}

/// A load that comes at 5 s, after the run has ended; a support that stands still does not change.
TEST(Until, ARunThatEndsBeforeItsLoadsDoSaysSo) {
  Scene scene = drop_scene(Mode::dynamic, 0.01, 1000, at_rest);
  const auto warned = [&] {
    BuiltScene built = build(scene);
    while (built.stepper->stage_ends().size() < 1 || built.stepper->stage_end().steps < 10)
      run(*built.stepper, 1);
    for (const std::string& text : ddacontact::warnings_of(*built.stepper))
      if (text.find("loads, supports or shaking change until t = 6 s") != std::string::npos) return true;
    return false;
  };
  scene.supports = {{0, {0}, true, true, {TimeFunction::Kind::ramp, Vec2::Zero(), {}}}};
  scene.blocks[0].fixed = false;
  scene.supports[0].vertices = {0, 1, 2, 3};
  EXPECT_FALSE(warned());
  ddacontact::Load load;
  load.kind = ddacontact::Load::Kind::body;
  load.block = 1;
  load.force = ddacontact::history_function(TimeFunction::Kind::history, {{5, 0, 0}, {6, 1e3, 0}});
  scene.loads = {load};
  EXPECT_TRUE(warned());
}

TEST(StaticVerdict, OutOfBalanceIsTold) {
  Scene scene = drop_scene(Mode::statics, 1, 5, {});
  scene.stages.pop_back();
  scene.stages[0].until.reset();
  const BuiltScene built = run(scene);
  const std::vector<std::string> warnings = warnings_of(*built.stepper);
  ASSERT_EQ(warnings.size(), 1u);
  for (const char* word : {"no equilibrium", "1 block", "\"falls\"", "by 1 of", "(more 'steps'"})
    EXPECT_NE(warnings[0].find(word), std::string::npos) << warnings[0];
}
