#include <tests/ddacontact/time/trial_of.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// A block on a plane that it slides down.
Scene sliding_down(double time_step, int steps) {
  Scene scene = default_mechanics(time_step);
  scene.analysis.steps = steps;
  scene.analysis.max_displacement_ratio = 1;
  const double angle = -radians(30);
  scene.blocks = {block(turned(rectangle(-2, -1, 20, 1), angle), true),
                  block(turned(rectangle(0, 0, 2, 1), angle))};
  return scene;
}

}  // namespace

TEST(Stepper, TheLastOneGoesOn) {
  Scene scene = sliding_down(0.01, 50);
  scene.stages = {scene.stage("first"), scene.stage("slide")};
  for (StageDescription& stage : scene.stages) stage.analysis.steps = 1;
  BuiltScene built = build(scene);
  run(*built.stepper, 10);
  EXPECT_EQ(built.stepper->counts().steps, 10);
  EXPECT_NEAR(built.stepper->state().time, 0.1, 1e-15);
}

TEST(Stepper, TimeRunsOnWithEachStagesStep) {
  Scene scene = sliding_down(0.01, 50);
  scene.stages = {scene.stage("coarse"), scene.stage("fine")};
  scene.stages[0].analysis.steps = 3;
  scene.stages[0].analysis.time_step = 0.02;
  scene.stages[1].analysis.steps = 4;
  scene.stages[1].analysis.time_step = 0.005;
  BuiltScene built = build(scene);
  run(*built.stepper, 7);
  EXPECT_DOUBLE_EQ(built.stepper->state().time, 0.08);
  EXPECT_DOUBLE_EQ(scene.end_time(), 0.08);
}

/// A block that may move by no more than a part of the scene in a step makes several.
/// A block that flies with the velocity of its support flies on: nothing works on it.
TEST(Stepper, ASupportInMotionStartsWithoutABlow) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::central_difference})
    for (const double time_step : {1e-2, 1e-4}) {
      Scene scene;
      scene.analysis.scheme = scheme;
      scene.analysis.time_step = time_step;
      scene.analysis.steps = 20;
      scene.analysis.gravity.setZero();
      scene.materials = {{"rock", 2500, 1e10, 0.2}};
      scene.joints = {{"joint", 30, 0, 0, std::nullopt}};
      scene.blocks = {block(rectangle(0, 0, 1, 1))};
      scene.blocks[0].velocity = {1.5, 0};
      scene.supports = {{0, {0, 3}, true, false, {TimeFunction::Kind::rate, {1.5, 0}, {}}}};
      const BuiltScene built = run(scene);
      const double kinetic = 2500 * 1.5 * 1.5 / 2;
      EXPECT_NEAR(built.stepper->energy().now.kinetic, kinetic, 1e-9 * kinetic) << time_step;
      EXPECT_NEAR(built.stepper->energy().now.external, 0, 1e-9 * kinetic) << time_step;
      EXPECT_NEAR(travel(*built.stepper, 0).x(), 30 * time_step, 1e-12);
    }
}

TEST(Stepper, CutsAStepThatMovesABlockTooFar) {
  Scene scene = sliding_down(0.1, 1);
  scene.analysis.gravity.setZero();
  scene.blocks = {block(rectangle(0, 0, 2, 1)), block(rectangle(90, 0, 2, 1))};
  scene.blocks[0].velocity = {10, 0};
  for (const double part : {1., 0.005}) {
    scene.analysis.max_displacement_ratio = part;
    const BuiltScene built = run(scene);
    EXPECT_EQ(built.stepper->counts().substeps >= 1 / (46 * 0.005), part < 1);
    EXPECT_LE(built.stepper->last_dt() * 10, part * 46 * (1 + 1e-9)) << "half of the larger side";
    EXPECT_EQ(built.stepper->counts().steps, 1);
    EXPECT_EQ(built.stepper->state().time, 0.1);
    EXPECT_NEAR(travel(*built.stepper, 0).x(), 1, 1e-9);
  }
}

/// The state is that of the last substep, and the run goes on from there as if nothing had been.
TEST(Stepper, AnInterruptedStepIsMadeLaterAsItWouldHaveBeen) {
  Scene scene = sliding_down(0.02, 3);
  scene.analysis.max_displacement_ratio = 1e-3;  // ten substeps or so
  scene.blocks[1].velocity = 5 * Vec2(std::cos(radians(30)), -std::sin(radians(30)));
  const BuiltScene whole = run(scene);
  BuiltScene stopped = build(scene);
  int trials = 0;
  stopped.stepper->interrupt_when([&] { return ++trials == 3; });
  EXPECT_FALSE(stopped.stepper->step());
  EXPECT_EQ(stopped.stepper->stop_reason(), "interrupted");
  EXPECT_EQ(stopped.stepper->counts().steps, 0);
  EXPECT_GT(stopped.stepper->state().time, 0);
  EXPECT_LT(stopped.stepper->state().time, 0.01);
  run(*stopped.stepper, 3);
  EXPECT_EQ(stopped.stepper->state().time, whole.stepper->state().time);
  EXPECT_EQ(stopped.stepper->state().position, whole.stepper->state().position);
}

TEST(Stepper, StopsWhereNoSubstepIsShortEnough) {
  Scene scene = rock_scene(0.01, 1);
  scene.analysis.gravity.setZero();
  scene.materials[0].young = 1e3;
  scene.blocks = {block(rectangle(0, 0, 1, 1), true), block(rectangle(0.5, 2, 1, 1))};
  // Two supports drive one block into another, which no substep mends.
  scene.supports = {{1,
                     {0, 1, 2, 3},
                     true,
                     true,
                     {TimeFunction::Kind::history, {}, {{0, 0, 0}, {1e-9, 0, -1.5}, {1, 0, -1.5}}}}};
  const BuiltScene built = build(scene);
  EXPECT_FALSE(built.stepper->step());
  EXPECT_NE(built.stepper->stop_reason().find("even with a substep of"), std::string::npos)
      << built.stepper->stop_reason();
  EXPECT_EQ(built.stepper->state().time, 0);
  EXPECT_GT(built.stepper->counts().rejected, 1);
}

/// A damping that leaves nothing of the stiffness of contacts above the round-off is told, not computed with.
TEST(Stepper, StopsWhereDampingDrownsContacts) {
  Scene scene = default_mechanics(0.01);
  scene.analysis.damping.stiffness = 1e16;
  scene.blocks = {block(rectangle(-5, -1, 10, 1), true), block(rectangle(0, 0, 1, 1)),
                  block(rectangle(0, 1, 1, 1))};
  const BuiltScene built = build(scene);
  bool made = true;
  for (int k = 0; k < 20 && made; ++k) made = built.stepper->step();
  EXPECT_FALSE(made);
  EXPECT_NE(built.stepper->stop_reason(), "");
  EXPECT_TRUE(built.stepper->state().position.allFinite());
}
