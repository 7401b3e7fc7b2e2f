#include <ddacontact/scene/held_corners.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/concave_polygons.hpp>

#include <numbers>

using namespace ddacontact;

namespace {

constexpr double half_a_turn = std::numbers::pi;

std::vector<HeldCorner> corners_of(const Scene& scene) {
  const support::BuiltScene built = build(scene);
  std::vector<HeldCorner> corners =
      held_corners(built.stepper->blocks(), built.stepper->state(), built.stepper->stages());
  for (HeldCorner& corner : corners) corner.at += built.labels.origin;
  return corners;
}

/// Ground with its surface at y = 0 up to x = 0, beside a block whose face goes on by an angle.
Scene ground_and_face(double angle) {
  Scene scene = support::rock_scene(0.01, 1);
  scene.blocks = {support::block(support::rectangle(-6, -3, 6, 3), true),
                  support::block(support::points({{0, -3}, {9, -3}, {9, 9 * std::tan(angle)}, {0, 0}}), true),
                  support::block(support::rectangle(3, 20, 1, 1))};
  return scene;
}

const HeldCorner& at_origin(const std::vector<HeldCorner>& corners) {
  return *std::ranges::find_if(corners, [](const HeldCorner& corner) { return corner.at.norm() < 1e-9; });
}

}  // namespace

TEST(HeldCorners, TheSurfaceOfTwoBlocksBendsAtTheirJoint) {
  for (const double angle : {0.3, 0.0, -0.2}) {
    SCOPED_TRACE(angle);
    const std::vector<HeldCorner> corners = corners_of(ground_and_face(angle));
    ASSERT_EQ(corners.size(), 4u) << "two at the top, two at the bottom of the joint";
    const HeldCorner& top = at_origin(corners);
    EXPECT_NEAR(top.free, half_a_turn - angle, 1e-12);
    EXPECT_LE((top.in - Vec2(-std::cos(angle), -std::sin(angle))).norm(), 1e-12) << "down the face";
    EXPECT_LE((top.out - Vec2(-1, 0)).norm(), 1e-12) << "along the ground";
    EXPECT_EQ(top.in_block, 1);
    EXPECT_EQ(top.out_block, 0);
    EXPECT_EQ(std::ranges::count_if(corners, &HeldCorner::is_first), 2);
  }
}

/// A block on the middle of the ground: its foot is a bend, whether another block is there or not.
TEST(HeldCorners, ACornerOnAnEdgeHasHalfATurnBelowIt) {
  Scene scene = ground_and_face(0);
  scene.blocks.push_back(support::block(support::rectangle(-4, 0, 1, 1), true));
  const std::vector<HeldCorner> corners = corners_of(scene);
  const auto foot = std::ranges::find_if(
      corners, [](const HeldCorner& corner) { return (corner.at - Vec2(-4, 0)).norm() < 1e-9; });
  ASSERT_NE(foot, corners.end());
  EXPECT_EQ(foot->block, 3);
  EXPECT_EQ(foot->in_block, 3);
  EXPECT_EQ(foot->out_block, 0);
  EXPECT_TRUE(foot->is_first) << "the ground has no vertex there";
  EXPECT_NEAR(foot->free, half_a_turn / 2, 1e-12);
  EXPECT_LE((foot->in - Vec2(0, -1)).norm(), 1e-12);
  EXPECT_LE((foot->out - Vec2(-1, 0)).norm(), 1e-12);
}

TEST(HeldCorners, NothingIsFreeBetweenFour) {
  Scene scene = support::rock_scene(0.01, 1);
  for (const double x : {-1, 0})
    for (const double y : {-1, 0})
      scene.blocks.push_back(support::block(support::rectangle(x, y, 1, 1), true));
  EXPECT_NEAR(at_origin(corners_of(scene)).free, 0, 1e-12);
}

TEST(HeldCorners, BlocksThatMoveOrGoAreNotCounted) {
  Scene scene = ground_and_face(0.3);
  scene.blocks[0].fixed = false;
  EXPECT_TRUE(corners_of(scene).empty());
  scene.blocks[0].fixed = true;
  scene.analysis.steps = 2;
  scene.stages = {scene.stage(""), scene.stage("")};
  scene.stages[1].removed = {1};
  EXPECT_TRUE(corners_of(scene).empty());
}
