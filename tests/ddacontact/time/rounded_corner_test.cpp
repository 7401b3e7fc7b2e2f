// Blocks with rounded corners: what rolls rolls, and what stands on its faces stands and slides on them.
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/flush_joints.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

using namespace ddacontact;
using namespace support;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A square of 1 m, turned clockwise and then placed with its lowest point at the origin of a large fixed
/// slope.
Scene square_on_a_slope(double dip, double friction_angle, double rounding, double turned, double duration) {
  Scene scene = on_a_crossed_plane(
      {.dip = dip}, {.friction_angle = friction_angle, .time_step = 1e-3, .duration = duration});
  scene.contact.corner_rounding = rounding;
  const Mat2 slope_turn = Eigen::Rotation2Dd(-dip * degree).toRotationMatrix();
  scene.blocks.erase(scene.blocks.begin(), scene.blocks.begin() + 2);
  Points slope(2, 4), square(2, 4);
  slope << -20, 20, 20, -20, -20, -20, 0, 0;
  square << -0.5, 0.5, 0.5, -0.5, -0.5, -0.5, 0.5, 0.5;
  square = Eigen::Rotation2Dd(-turned * degree).toRotationMatrix() * square;
  const double half = 0.5 - rounding;  // from the middle to the centres of the circles
  const double lowest = half * (std::cos(turned * degree) + std::sin(turned * degree)) + rounding;
  square.row(1).array() += lowest;
  scene.blocks[0].vertices = slope_turn * slope;
  scene.blocks[1].vertices = slope_turn * square;
  return scene;
}

/// A wedge on a face of 20 degrees with its foot at level ground, of the same block as the face or of another.
Scene wedge_at_level_ground(bool ground_is_another) {
  Scene scene = on_a_crossed_plane({.dip = 0}, {.friction_angle = 5, .time_step = 0.01, .duration = 1});
  scene.contact.corner_rounding = 0.003;
  const double height = 12 * std::tan(20 * degree);
  const Points wedge = points({{0, 0}, {12, height}, {12, 6}, {5, 6}});
  scene.blocks = {block(points({{-6, -3}, {12, -3}, {12, height}, {0, 0}, {-6, 0}}), true), block(wedge)};
  scene.blocks[0].model = BlockModel::mean_value;
  if (ground_is_another) {
    scene.blocks[0].vertices = points({{0, -3}, {12, -3}, {12, height}, {0, 0}});
    scene.blocks.push_back(block(rectangle(-6, -3, 6, 3), true));
  }
  return scene;
}

}  // namespace

/// Corners of two blocks that stay together are not corners where the surface bends inwards: a rounded foot
/// would sink into the gap that their arcs leave, and the wedge would rest without friction.
TEST(RoundedCorner, AFootPassesTheJointOfWhatIsHeldAsItPassesABend) {
  std::vector<Vec2> ways;
  for (const bool ground_is_another : {false, true}) {
    const BuiltScene built = build(wedge_at_level_ground(ground_is_another));
    run(*built.stepper, 100);
    ways.push_back(travel(*built.stepper, 1));
  }
  EXPECT_LT(ways[0].x(), -0.5);
  EXPECT_LE((ways[1] - ways[0]).norm(), 1e-3 * ways[0].norm());
}

/// Rolling on the arc of its corner r it keeps its energy: with the middle G at a distance c = (1/2 - r) sqrt
/// 2 from the arc's centre C, at an angle b from the vertical, and |GP| from the point that touches,
///     (I + m |GP|^2) w^2 / 2 = m g c (cos b0 - cos b),    C moves by r (b - b0).
TEST(RoundedCorner, ATiltedSquareRollsOnItsArc) {
  for (const double r : {0.05, 0.2}) {
    const double duration = 0.6, turned = 40;
    const BuiltScene built = build(square_on_a_slope(0, 70, r, turned, duration));
    Stepper& stepper = *built.stepper;
    const BlockSystem& blocks = stepper.blocks();
    const Range& v = blocks.block(1).vertices();
    const auto outline = [&] {
      const Points all = blocks.positions(stepper.state()).colwise() + built.labels.origin;
      return Points(all.middleCols(v.first, v.count));
    };
    const Points start = outline();
    while (stepper.state().time < duration - 1e-9) ASSERT_TRUE(stepper.step()) << stepper.stop_reason();

    const double c = (0.5 - r) * std::numbers::sqrt2, turn = best_fit_rotation(start, outline());
    // The square was turned clockwise and falls back: G is to the left of C, further with time.
    const double b0 = 45 - turned, b = b0 + turn / degree;
    const Vec2 G = outline().rowwise().mean();
    ASSERT_GT(turn, 5 * degree);
    ASSERT_LT(turn, turned * degree);
    const Vec2 C(c * std::sin(b0 * degree) - r * turn, r);
    EXPECT_LE((C + c * Vec2(-std::sin(b * degree), std::cos(b * degree)) - G).norm(), 1e-3);
    const double inertia = 1.0 / 6 + (G - Vec2(C.x(), 0)).squaredNorm(),
                 speed = std::sqrt(2 * 9.8 * c * (std::cos(b0 * degree) - std::cos(b * degree)) / inertia);
    const double w = rigid_velocity(blocks.block(1), stepper.state(), stepper.state().velocity).angular;
    EXPECT_NEAR(w, speed, 0.01 * speed);
  }
}

TEST(RoundedCorner, ABlockStandsAndSlidesOnItsFaces) {
  const Vec2 down(std::cos(20 * degree), -std::sin(20 * degree));
  for (const double rounding : {0.001, 0.01, 0.1}) {
    EXPECT_NEAR(final_speed(square_on_a_slope(20, 21, rounding, 0, 0.3), 1, down), 0, 1e-6) << rounding;
    const double friction = std::tan(10 * degree),
                 expected = 9.8 * (std::sin(20 * degree) - std::cos(20 * degree) * friction) * 0.3;
    EXPECT_NEAR(final_speed(square_on_a_slope(20, 10, rounding, 0, 0.3), 1, down), expected, 1e-3 * expected)
        << rounding;
  }
}

/// A tower of 1 m by 3 m flush with the corner of the large block that it stands on, gravity tilted towards
/// it: it turns about the end of its own arc, at tan a = (0.5 - r) / 1.5, in whatever order the blocks are.
TEST(RoundedCorner, WhereCornersMeetTheSmallerBlockTurnsAboutItsOwn) {
  constexpr double rounding = 0.01;
  const double limit = std::atan((0.5 - rounding * std::sqrt(3)) / 1.5);
  for (const bool base_first : {true, false})
    for (const double tilt : {limit - 0.3 * degree, limit + 0.3 * degree}) {
      Scene scene = rock_scene(0.02, 60);
      scene.analysis.mode = Mode::statics;
      scene.analysis.gravity = 9.8 * Vec2(std::sin(tilt), -std::cos(tilt));
      scene.joints[0].friction_angle = 45;
      scene.contact.corner_rounding = rounding;
      scene.blocks = {block(rectangle(-9, -9, 10, 9), true), block(rectangle(0, 0, 1, 3))};
      if (!base_first) std::swap(scene.blocks[0], scene.blocks[1]);
      EXPECT_EQ(run(scene).stepper->is_at_rest(), tilt < limit) << base_first << ' ' << tilt / degree;
    }
}
