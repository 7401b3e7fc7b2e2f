// What a run says of the balance of its blocks, by hand.
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

constexpr double g = 9.8;

Scene stone_scene(Mode mode, double time_step, int steps, double friction_degrees) {
  Scene scene;
  scene.analysis.mode = mode;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = steps;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"stone", 2500, 35e9, 0.2}};
  scene.joints = {{"joint", friction_degrees, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * 35e9;
  scene.contact.tangential_stiffness = 16 * 35e9;
  return scene;
}

/// A block of 2 m x 1 m on a fixed slope that rises to the left.
Scene slope_scene(Mode mode, double time_step, int steps, double degrees, double friction_degrees) {
  Scene scene = stone_scene(mode, time_step, steps, friction_degrees);
  const double angle = -radians(degrees);
  scene.blocks = {block(turned(rectangle(-2, -1, 40, 1), angle), true),
                  block(turned(rectangle(0, 0, 2, 1), angle))};
  return scene;
}

class EveryStep : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Equilibrium, EveryStep, testing::Values(1e-6, 1e-3, 5e-3, 5e-2, 0.5));
/// In shorter ones blocks vibrate for many more steps than a test can make.
class SettlingStep : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Equilibrium, SettlingStep, testing::Values(1e-3, 5e-3, 5e-2, 0.5));

}  // namespace

TEST_P(EveryStep, WhatFallsFreelyIsOutOfBalanceByItsWeight) {
  for (const Mode mode : {Mode::statics, Mode::dynamic})
    for (const BlockModel model : {BlockModel::wachspress, BlockModel::affine, BlockModel::mesh}) {
      Scene scene = stone_scene(mode, GetParam(), 3, 30);
      scene.blocks = {block(rectangle(-5, -1, 1, 1), true), block(rectangle(0, 0, 2, 1))};
      scene.blocks[1].model = model;
      const BuiltScene built = run(scene);
      EXPECT_NEAR(built.stepper->equilibrium().unbalanced, 1, 1e-9);
      EXPECT_EQ(built.stepper->equilibrium().unbalanced_block, 1);
      EXPECT_EQ(built.stepper->equilibrium().fastest_block, 1);
      EXPECT_EQ(built.stepper->equilibrium().n_unbalanced, 1);
      EXPECT_FALSE(built.stepper->is_at_rest());
      // Dynamic: in the middle of the last step.
      const double speed = mode == Mode::statics ? g * built.stepper->last_dt()
                                                 : g * (3 * GetParam() - built.stepper->last_dt() / 2);
      EXPECT_NEAR(built.stepper->equilibrium().fastest, speed, 1e-6 * speed);
    }
}

/// Of the weight, the largest force on it.
TEST_P(SettlingStep, WhatSlidesIsOutOfBalanceByItsDrivingForce) {
  const double a = radians(30), phi = radians(20);
  const BuiltScene built = run(slope_scene(Mode::statics, GetParam(), 20, 30, 20));
  EXPECT_NEAR(built.stepper->equilibrium().unbalanced, std::sin(a) - std::cos(a) * std::tan(phi), 1e-5);
  EXPECT_FALSE(built.stepper->is_at_rest());
}

TEST_P(SettlingStep, WhatFrictionHoldsIsAtRest) {
  const BuiltScene built = run(slope_scene(Mode::statics, GetParam(), 20, 30, 31));
  EXPECT_LE(built.stepper->equilibrium().unbalanced, 1e-6);
  EXPECT_TRUE(built.stepper->is_at_rest());
}

TEST_P(SettlingStep, AColumnThatStandsIsAtRestAndOneThatLeansTooFarIsNot) {
  for (const double part : {0.97, 1.03}) {
    const int steps =
        std::max(12, static_cast<int>(1 / GetParam()));  // long vibrations decay slowly in short ones
    Scene scene = stone_scene(Mode::statics, GetParam(), steps, 40);
    scene.blocks = {block(rectangle(-5, -1, 12, 1), true)};
    for (int k = 0; k < 4; ++k) {
      scene.blocks.push_back(block(rectangle(0, k, 1, 1)));
      scene.loads.push_back(body_load(k + 1, constant(part * Vec2(2500 * g / 4, 0))));
    }
    const BuiltScene built = run(scene);
    EXPECT_EQ(built.stepper->is_at_rest(), part < 1)
        << part << ": " << built.stepper->equilibrium().unbalanced;
  }
}

/// A plate held at two corners, and a bonded block under a ceiling.
TEST(Equilibrium, CountsReactionsAndBonds) {
  for (const BlockModel model : {BlockModel::wachspress, BlockModel::affine, BlockModel::mesh}) {
    Scene scene = stone_scene(Mode::statics, 0.01, 12, 30);
    scene.joints[0].cohesion = scene.joints[0].tensile_strength = 1e6;
    scene.blocks = {block(rectangle(0, 0, 2, 1)), block(rectangle(5, 2, 4, 1), true),
                    block(rectangle(6, 1, 2, 1))};
    scene.blocks[0].fixed_vertices = {0, 1};
    scene.blocks[0].model = scene.blocks[2].model = model;
    const BuiltScene built = run(scene);
    EXPECT_LE(built.stepper->equilibrium().unbalanced, 1e-6) << static_cast<int>(model);
    EXPECT_TRUE(built.stepper->is_at_rest());
  }
}

/// Two equal and opposite forces off its centroid: without a resultant, and no weight.
TEST(Equilibrium, ACoupleIsOutOfBalance) {
  Scene scene = stone_scene(Mode::statics, 0.01, 3, 30);
  scene.analysis.gravity = Vec2(0, 0);
  scene.blocks = {block(rectangle(-9, -1, 1, 1), true), block(rectangle(0, 0, 2, 2))};
  scene.loads = {point_load(1, Vec2(0, 1), constant(Vec2(0, -1e3))),
                 point_load(1, Vec2(2, 1), constant(Vec2(0, 1e3)))};
  EXPECT_GT(run(scene).stepper->equilibrium().unbalanced, 0.5);
}

TEST(Equilibrium, DynamicRunsAreAtRestWhenNothingMovesAndForcesBalance) {
  Scene sliding = slope_scene(Mode::dynamic, 0.01, 100, 30, 30);
  sliding.blocks[1].velocity = 0.5 * Vec2(std::cos(radians(30)), -std::sin(radians(30)));
  const BuiltScene slides = run(sliding);
  EXPECT_LE(slides.stepper->equilibrium().unbalanced, 1e-4) << "it keeps its speed";
  EXPECT_GT(slides.stepper->equilibrium().fastest, 0.4);
  EXPECT_FALSE(slides.stepper->is_at_rest());
  Scene scene = slope_scene(Mode::dynamic, 0.01, 200, 30, 31);
  for (const bool sleeps : {true, false}) {
    scene.analysis.skip.sleep = sleeps;
    const BuiltScene rests = run(scene);
    EXPECT_TRUE(rests.stepper->is_at_rest())
        << rests.stepper->equilibrium().unbalanced << ", " << rests.stepper->equilibrium().fastest;
    EXPECT_EQ(rests.stepper->is_asleep(1), sleeps);
  }
  // At the top of its flight: in the middle of the step before half of what gravity gives in a step, and its
  // weight.
  Scene thrown = stone_scene(Mode::dynamic, 0.0625, 16, 0);
  thrown.blocks = {block(rectangle(-5, -1, 1, 1), true), block(rectangle(0, 0, 2, 1))};
  thrown.blocks[1].velocity = Vec2(0, g);
  const BuiltScene at_top = run(thrown);
  EXPECT_NEAR(at_top.stepper->equilibrium().fastest, g * 0.0625 / 2, 1e-9);
  EXPECT_LT(at_top.stepper->state().velocity.norm(), 1e-9);
  EXPECT_FALSE(at_top.stepper->is_at_rest());
}

/// Soft blocks whose vibration a short step hardly damps: not at rest before it has decayed.
TEST(Equilibrium, StaticRunsThatStillSettleAreNotAtRest) {
  Scene scene = stone_scene(Mode::statics, 5e-3, 3, 30);
  scene.materials[0].young = 1e7;
  scene.blocks = {block(rectangle(-5, -1, 12, 1), true), block(rectangle(0, 0, 2, 2))};
  const BuiltScene built = run(scene);
  EXPECT_GT(built.stepper->equilibrium().unbalanced, 1e-3);
  EXPECT_FALSE(built.stepper->is_at_rest());
  run(*built.stepper, 2000);
  EXPECT_TRUE(built.stepper->is_at_rest()) << built.stepper->equilibrium().unbalanced;
}
