#include <ddacontact/time/driven_blocks.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

/// Two unit squares side by side, `gap` apart, held wholly and moved by their supports over the run.
Scene driven(double gap, const Vec2& left, const Vec2& right) {
  Scene scene = default_mechanics(rock_scene(0.01, 10));
  scene.blocks = {block(rectangle(0, 0, 1, 1)), block(rectangle(1 + gap, 0, 1, 1))};
  for (int b : {0, 1}) {
    Support support;
    support.block = b;
    support.vertices = {0, 1, 2, 3};
    support.displacement = {TimeFunction::Kind::ramp, b == 0 ? left : right, {}};
    scene.supports.push_back(support);
  }
  return scene;
}

std::string reason_to_stop(const Scene& scene) {
  const BuiltScene built = build(scene);
  for (int k = 0; k < scene.analysis.steps; ++k)
    if (!built.stepper->step()) return built.stepper->stop_reason();
  return "";
}

}  // namespace

TEST(DrivenBlocks, SupportsThatDriveBlocksIntoEachOtherStopTheRunAndAreNamed) {
  const std::string reason = reason_to_stop(driven(0.01, {0.1, 0}, {-0.1, 0}));
  EXPECT_NE(reason.find("supports drive blocks \"0\" and \"1\" into each other"), std::string::npos)
      << reason;
}

TEST(DrivenBlocks, SupportsThatPartOrSlideBlocksDoNot) {
  EXPECT_EQ(reason_to_stop(driven(0, {-0.1, 0}, {0.1, 0})), "");
  EXPECT_EQ(reason_to_stop(driven(0, {0, 0.1}, {0, -0.1})), "");
}

TEST(DrivenBlocks, ManySmallStepsDriveThemNoFurtherThanALongOne) {
  Scene slow = driven(0, {1e-4, 0}, {0, 0});
  slow.analysis.steps = 100;
  EXPECT_NE(reason_to_stop(slow).find("into each other"), std::string::npos);
}

/// N = k_n l overlap, T = k_s l slip up to friction: what a direct shear test at constant height prescribes.
TEST(DrivenBlocks, AJointWithAStiffnessBearsWhatSupportsPrescribe) {
  for (const double slip : {1e-5, 1e-3}) {
    Scene scene = driven(0, {1e-4, slip}, {0, 0});
    scene.analysis.mode = Mode::statics;
    scene.analysis.time_step = 1;  // what static steps of moving supports add to forces is small then
    scene.analysis.gravity.setZero();
    scene.joints[0].friction_angle = 30;
    scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = 1e9;
    const BuiltScene built = build(scene);
    run(*built.stepper, 10);
    double normal = 0, shear = 0;
    for (const ddacontact::ContactRecord& contact : built.stepper->contacts()) {
      normal += contact.normal;
      shear += contact.shear;
    }
    const double expected = 1e9 * 1e-4;
    EXPECT_NEAR(normal, expected, 2e-3 * expected) << "the faces overlap by a little less as they slip";
    EXPECT_NEAR(std::abs(shear), std::min(1e9 * slip, std::tan(radians(30)) * expected), 2e-3 * expected);
    EXPECT_NEAR(built.stepper->reactions().row(0).head(4).sum(), expected, 2e-3 * expected);
  }
}

TEST(DrivenBlocks, AnOverlapOfTheStartIsNoDrivenOne) {
  EXPECT_EQ(reason_to_stop(driven(-1. / 1024, {0, 0.1}, {0, -0.1})), "");
}

/// A block held at two vertices has unknowns left, but no room below it.
TEST(DrivenBlocks, ABlockHeldInPartThatHasNoRoomHasItsSupportsNamed) {
  Scene scene = driven(0, {0, 0}, {0, -0.05});
  scene.blocks[0] = block(rectangle(0, -1, 4, 1), true);
  scene.supports.erase(scene.supports.begin());
  scene.supports[0].vertices = {0, 1};
  const std::string reason = reason_to_stop(scene);
  EXPECT_NE(reason.find("supports drive blocks \"0\" and \"1\" into each other"), std::string::npos)
      << reason;
}

/// Held along x alone, or at the faces that meet alone, blocks have unknowns, but none that would part them.
TEST(DrivenBlocks, BlocksHeldInPartThatNothingCanPartStopTheRunAndAreNamed) {
  for (const bool along_x : {true, false})
    for (const double gap : {0., 0.01}) {
      Scene scene = driven(gap, {0.1, 0}, {-0.1, 0});
      scene.analysis.gravity.setZero();
      for (Support& support : scene.supports) support.fix_y = !along_x;
      if (!along_x) {
        scene.supports[0].vertices = {1, 2};
        scene.supports[1].vertices = {0, 3};
      }
      const std::string reason = reason_to_stop(scene);
      EXPECT_NE(reason.find("supports drive blocks \"0\" and \"1\" into each other"), std::string::npos)
          << reason;
      for (Support& support : scene.supports) support.displacement.value *= -1;
      EXPECT_EQ(reason_to_stop(scene), "") << "apart";
    }
}

/// Vertices that supports hold across the joint, and leave free along it, have no force that one could tell.
TEST(DrivenBlocks, WhatSupportsPressTogetherIsNotPushedApart) {
  Scene scene = driven(0, {0, 0}, {-6e-4, 0});
  scene.blocks[1].vertices.row(1).array() += 0.3;
  for (Support& support : scene.supports) support.fix_y = false;
  scene.analysis.gravity.setZero();
  const BuiltScene built = build(scene);
  for (int step = 0; step < scene.analysis.steps; ++step)
    ASSERT_TRUE(built.stepper->step()) << built.stepper->stop_reason();
  const Energy& energy = built.stepper->energy().now;
  EXPECT_EQ(built.stepper->counts().rejected, 0);
  EXPECT_LT(std::abs(energy.external), 1e-2);
  EXPECT_LT(energy.pushed_out, 1e-2);
}
