#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

/// A bond that carries only tension: its block hangs straight down, no shear is needed. (With friction but
/// without cohesion the cone's apex is at no tension at all, and the first shear breaks the bond.)
TEST(Strength, ABondWithoutFrictionBearsTensionWithoutCohesion) {
  Scene scene = rock_scene(0.02, 50);
  scene.analysis.mode = Mode::statics;
  scene.joints = {{"glue", 0, 0, 20.02e3, std::nullopt}};
  scene.blocks = {block(rectangle(-1, 1, 3, 1), true), block(rectangle(0, 0, 1, 1))};
  EXPECT_GT(travel(*run(scene).stepper, 1).y(), -0.01);
}

/// Torn off and put back, a bond is gone.
TEST(Strength, ABondIsLostForGood) {
  Scene scene = rock_scene(0.02, 60);
  scene.analysis.mode = Mode::statics;
  scene.joints = {{"glue", 0, 0, 10e3, std::nullopt}};
  scene.analysis.gravity.setZero();
  scene.blocks = {block(rectangle(-1, 1, 3, 1), true), block(rectangle(0, 0, 1, 1))};
  // Pulled down by 20 kN, pushed up again, then pulled by half of what the bond bore.
  scene.loads = {
      body_load(1, {TimeFunction::Kind::history,
                    {0, 0},
                    {{0, 0, -20e3}, {0.2, 0, -20e3}, {0.21, 0, 60e3}, {0.6, 0, 60e3}, {0.61, 0, -5e3}}})};
  const BuiltScene built = build(scene);
  run(*built.stepper, 10);
  EXPECT_LT(travel(*built.stepper, 1).y(), -0.01);
  run(*built.stepper, 20);
  EXPECT_GT(travel(*built.stepper, 1).y(), -1e-5);
  run(*built.stepper, 30);
  EXPECT_LT(travel(*built.stepper, 1).y(), -0.01);
}
