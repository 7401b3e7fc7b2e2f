#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

constexpr BlockModel models[] = {BlockModel::wachspress, BlockModel::affine};

Scene one_free_block(BlockModel model, double dt, int steps) {
  Scene scene = rock_scene(dt, steps);
  Points pentagon(2, 5);
  pentagon << 0, 2, 2.5, 1, -0.5, 0, 0, 1, 2, 1;
  scene.blocks = {block(pentagon)};
  scene.blocks[0].model = model;
  return scene;
}

}  // namespace

TEST(FreeMotion, AProjectileFliesAsGalileoSaysAtEveryStep) {
  for (BlockModel model : models) {
    Scene scene = one_free_block(model, 0.01, 60);
    scene.blocks[0].velocity = {3, 4};
    const BuiltScene built = build(scene);
    for (int k = 1; k <= 60; ++k) {
      run(*built.stepper, 1);
      const double t = 0.01 * k;
      EXPECT_LE((travel(*built.stepper, 0) - Vec2(3 * t, 4 * t - 5 * t * t)).norm(), 1e-12);
      const RigidVelocity v =
          rigid_velocity(built.stepper->blocks().block(0), built.stepper->state().velocity);
      EXPECT_LE((v.linear - Vec2(3, 4 - 10 * t)).norm(), 1e-10);
      EXPECT_NEAR(v.angular, 0, 1e-10);
      EXPECT_LE(built.stepper->state().stress.norm(), 1e-2);  // of 100 MPa
    }
    EXPECT_DOUBLE_EQ(built.stepper->state().time, 0.6);
    EXPECT_EQ(built.stepper->counts().rejected, 0);
  }
}

/// A static step starts at rest: the way of one step from rest, again and again.
TEST(FreeMotion, AStaticFallIsMadeOfStepsFromRest) {
  Scene scene = one_free_block(BlockModel::wachspress, 0.01, 8);
  scene.analysis.mode = Mode::statics;
  const BuiltScene built = run(scene);
  EXPECT_NEAR(travel(*built.stepper, 0).y(), -8 * 5 * 1e-4, 1e-13);
  EXPECT_EQ(built.stepper->state().velocity.norm(), 0);
}

/// The laws of linear displacement updates: the motion of the vertices is along their tangents, so that area
/// grows; what that does to the angular velocity depends on the unknowns.
TEST(FreeMotion, ASpinningVertexBlockSlowsDownAsItInflates) {
  Scene scene = one_free_block(BlockModel::wachspress, 0.01, 200);
  scene.analysis.gravity.setZero();
  scene.blocks[0].angular_velocity = 6.3;
  scene.analysis.max_displacement_ratio = 1;
  const BuiltScene built = build(scene);
  const double dtheta = 6.3 * 0.01;
  for (int n = 50; n <= 200; n += 50) {
    run(*built.stepper, 50);
    const Block& of = built.stepper->blocks().block(0);
    const double law = 1 + n * dtheta * dtheta;
    EXPECT_NEAR(rigid_velocity(of, built.stepper->state().velocity).angular, 6.3 / std::sqrt(law),
                0.01 * 6.3);
    EXPECT_NEAR(of.moments().area / of.reference_area(), law, 0.01 * law);
  }
}

TEST(FreeMotion, ASpinningBlockOfSixUnknownsKeepsItsAngularVelocityAndInflates) {
  Scene scene = one_free_block(BlockModel::affine, 0.01, 200);
  scene.analysis.gravity.setZero();
  scene.blocks[0].angular_velocity = 6.3;
  scene.analysis.max_displacement_ratio = 1;
  const BuiltScene built = run(scene);
  const Block& of = built.stepper->blocks().block(0);
  EXPECT_NEAR(rigid_velocity(of, built.stepper->state().velocity).angular, 6.3, 0.063);
  const double law = std::pow(1 + std::pow(6.3 * 0.01, 2), 200);
  EXPECT_NEAR(of.moments().area / of.reference_area(), law, 0.01 * law);
  EXPECT_NEAR(built.stepper->state().rotation[0], 200 * std::atan(0.063), 1e-6);  // not wrapped: two turns
}

TEST(FreeMotion, SubstepsOfAFreeFallLeaveItExact) {
  for (Preset preset : {Preset::standard, Preset::paper}) {
    Scene scene = one_free_block(BlockModel::wachspress, 0.1, 10);
    scene.analysis.preset = preset;
    scene.analysis.max_displacement_ratio = 0.1;  // 0.15 m of the block's 3
    const BuiltScene built = build(scene);
    for (int k = 1; k <= 10; ++k) {
      run(*built.stepper, 1);
      EXPECT_EQ(built.stepper->state().time, 0.1 * k);
      EXPECT_NEAR(travel(*built.stepper, 0).y(), -5 * std::pow(0.1 * k, 2), 1e-11);
    }
    EXPECT_GT(built.stepper->counts().substeps, 30);
    EXPECT_EQ(built.stepper->counts().steps, 10);
    EXPECT_LT(built.stepper->last_dt() * 10, 0.15);
    EXPECT_EQ(built.stepper->counts().rejected, 0);  // the limit is predicted
  }
}

TEST(FreeMotion, ALimitThatNoSubstepMeetsStopsTheRunAndNamesTheBlock) {
  Scene scene = one_free_block(BlockModel::wachspress, 0.1, 10);
  scene.blocks[0].name = "meteor";
  scene.blocks[0].velocity = {1, 0};
  scene.analysis.max_displacement_ratio = 1e-9;
  const BuiltScene built = build(scene);
  EXPECT_FALSE(built.stepper->step());
  EXPECT_NE(built.stepper->stop_reason().find("\"meteor\""), std::string::npos)
      << built.stepper->stop_reason();
  EXPECT_EQ(built.stepper->state().time, 0);
  EXPECT_EQ(built.stepper->counts().steps, 0);
  EXPECT_EQ(travel(*built.stepper, 0), Vec2(0, 0));
}
