#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

Scene one_free_block(double dt, int steps) {
  Scene scene = rock_scene(dt, steps);
  Points pentagon(2, 5);
  pentagon << 0, 2, 2.5, 1, -0.5, 0, 0, 1, 2, 1;
  scene.blocks = {block(pentagon)};
  return scene;
}

}  // namespace

TEST(FreeMotion, SubstepsOfAFreeFallLeaveItExact) {
  for (Preset preset : {Preset::standard, Preset::paper}) {
    Scene scene = one_free_block(0.1, 10);
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
  Scene scene = one_free_block(0.1, 10);
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
