#include <ddacontact/scene/builder.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

#include <optional>

using namespace ddacontact;

namespace {

/// Ten steps of rock without blocks.
Scene rock_under(const std::optional<double>& tolerance, double friction_angle = 35) {
  Scene scene;
  scene.analysis.time_step = 0.01;
  scene.analysis.steps = 10;
  scene.analysis.gravity = Vec2(0, -10);
  scene.materials = {{"rock", 2500, 1e10, 0.2}};
  scene.joints = {{"joint", friction_angle, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 4e11;
  scene.contact.tangential_stiffness = 1.6e11;
  scene.contact.tolerance = tolerance;
  return scene;
}

/// Bricks in running bond that gravity finds at once, for a tenth of a second.
BuiltScene wall_after(const std::optional<double>& tolerance) {
  Scene scene = rock_under(tolerance);
  scene.blocks = {support::block(support::rectangle(-1, -1, 20, 1), true)};
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 15; ++column)
      scene.blocks.push_back(support::block(support::rectangle(column + 0.5 * (row % 2), 0.5 * row, 1, 0.5)));
  BuiltScene built = build(scene);
  for (int k = 0; k < scene.analysis.steps; ++k) EXPECT_TRUE(built.stepper->step());
  return built;
}

}  // namespace

TEST(Tolerance, IsOneToTheEighthUnlessACoarserOneIsAskedForAndStated) {
  const BuiltScene exact = wall_after(std::nullopt), coarse = wall_after(1e-3);
  EXPECT_EQ(exact.stepper->counts().largest_tolerance, 1e-8);
  EXPECT_LE(exact.stepper->counts().max_residual, 1e-8);
  EXPECT_EQ(coarse.stepper->counts().largest_tolerance, 1e-3);
  EXPECT_GT(coarse.stepper->counts().max_residual, 1e-8);
  EXPECT_LE(coarse.stepper->counts().max_residual, 1e-3);
}

TEST(Tolerance, OneForcedIsHeldInEveryStep) {
  for (double tolerance : {1e-10, 1e-5}) {
    const BuiltScene wall = wall_after(tolerance);
    EXPECT_EQ(wall.stepper->counts().largest_tolerance, tolerance);
    EXPECT_LE(wall.stepper->counts().max_residual, tolerance);
  }
}

/// A coarse tolerance does not hold a block that is pushed by a tenth more than its friction.
TEST(Tolerance, ACoarseOneTellsWhatSlidesFromWhatRests) {
  const double friction = std::tan(support::radians(5));
  for (const double part : {0.9, 1.1}) {
    Scene scene = rock_under(1e-2, 5);
    scene.analysis.mode = Mode::statics;
    scene.blocks = {support::block(support::rectangle(-2, -1, 9, 1), true),
                    support::block(support::rectangle(0, 0, 2, 1))};
    scene.loads = {support::body_load(1, support::constant({part * 10 * 2500 * friction, 0}))};
    const BuiltScene built = support::run(scene);
    const double way =
        part < 1 ? 0 : 10 * (part - 1) * 10 * friction * 0.01 * 0.01;  // from rest in each step
    EXPECT_NEAR(support::travel(*built.stepper, 1).x(), way, 1e-6) << part;
    EXPECT_EQ(built.stepper->equilibrium().in_balance(), part < 1);
  }
}

/// What is left over counts as a whole, not node by node: a block of more cells than the tolerance is small
/// fell only at finer tolerances.
TEST(Tolerance, ACoarseOneMovesBlocksOfManyCells) {
  Scene scene = rock_under(1e-2);
  BlockDescription one = support::block(support::rectangle(0, 0, 2, 1));
  one.model = BlockModel::mesh;
  one.mesh.cells = 200;
  scene.blocks = {one};
  const BuiltScene built = support::run(scene);
  EXPECT_NEAR(support::travel(*built.stepper, 0).y(), -10 * 0.1 * 0.1 / 2, 0.01 * 0.05);
}
