#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

/// A block of 1 x 1 m glued under a fixed one by a bond of this strength: it weighs 20 kN.
bool hangs(double tensile_strength, BlockModel model, double width_above) {
  Scene scene = rock_scene(0.02, 50);
  scene.analysis.mode = Mode::statics;
  scene.joints = {{"glue", 30, 1e6, tensile_strength, std::nullopt}};
  scene.blocks = {block(rectangle(0.5 - width_above / 2, 1, width_above, 1), true),
                  block(rectangle(0, 0, 1, 1))};
  scene.blocks[1].model = model;
  const BuiltScene built = run(scene);
  return travel(*built.stepper, 1).y() > -0.01;
}

/// A leaning block on a slope, its weight over the middle of its base, so that both contacts bear the same.
/// It is stiff against its joint, for both to move alike.
bool holds(double friction_degrees, double cohesion, double slope) {
  Scene scene = rock_scene(0.2, 50);
  scene.analysis.mode = Mode::statics;
  scene.materials[0].young = 1e13;
  scene.joints = {{"glue", friction_degrees, cohesion, 0, std::nullopt}};
  Points leaning(2, 4);  // parallelogram with upright sides once turned
  const double lean = std::tan(slope);
  leaning << 0, 2, 2 + lean, lean,  //
      0, 0, 1, 1;
  scene.blocks = {block(turned(rectangle(-4, -1, 10, 1), slope), true), block(turned(leaning, slope))};
  const BuiltScene built = run(scene);
  return travel(*built.stepper, 1).norm() < 1e-3;
}

}  // namespace

TEST(Strength, ABondedBlockHangsAsLongAsItsWeightIsBelowTheTensileStrengthTimesTheLength) {
  for (BlockModel model : {BlockModel::wachspress, BlockModel::affine})
    for (double width_above : {1., 3.}) {
      EXPECT_TRUE(hangs(20e3 * 1.001, model, width_above));
      EXPECT_FALSE(hangs(20e3 * 0.999, model, width_above));
    }
}

TEST(Strength, CohesionHoldsABlockOnASlopeThatFrictionAloneDoesNot) {
  // 2 m2 of 20 kN/m3 on a base of 2 m: 20 kPa along the slope times its sine.
  for (double friction : {0., 15.}) {
    const double slope = radians(30);
    const double needed = 20e3 * (std::sin(slope) - std::cos(slope) * std::tan(radians(friction)));
    EXPECT_TRUE(holds(friction, 1.001 * needed, slope)) << "friction " << friction;
    EXPECT_FALSE(holds(friction, 0.999 * needed, slope)) << "friction " << friction;
  }
}

TEST(Strength, FrictionHoldsABlockOnASlopeUpToItsAngle) {
  EXPECT_TRUE(holds(30.03, 0, radians(30)));
  EXPECT_FALSE(holds(29.97, 0, radians(30)));
}

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
