#include <ddacontact/time/driven_blocks.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

/// Two unit squares side by side, `gap` apart, held wholly and moved by their supports over the run.
Scene driven(double gap, const Vec2& left, const Vec2& right) {
  Scene scene = rock_scene(0.01, 10);
  scene.analysis.kinematics = Kinematics::corotational;
  scene.analysis.scheme = Scheme::decaying;
  scene.contact.method = ContactMethod::staged;
  scene.contact.penetration_tolerance = 1e-6;
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

TEST(DrivenBlocks, AnOverlapOfTheStartIsNoDrivenOne) {
  EXPECT_EQ(reason_to_stop(driven(-1. / 1024, {0, 0.1}, {0, -0.1})), "");
}
