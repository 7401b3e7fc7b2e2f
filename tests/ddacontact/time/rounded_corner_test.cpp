// Blocks with rounded corners: what rolls rolls, what stands stands, and a joint is the groove that it is.
#include <tests/support/flush_joints.hpp>
#include <tests/support/scene_changes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace ddacontact;
using namespace support;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A square of 1 m on a long fixed slope.
Scene square_on_a_slope(double dip, double friction_angle, double rounding, double duration) {
  Scene scene = on_a_crossed_plane({.dip = dip},
                                   {.friction_angle = friction_angle, .time_step = 1e-3, .duration = duration});
  scene.contact.corner_rounding = rounding;
  const Vec2 down(std::cos(dip * degree), -std::sin(dip * degree)), out(-down.y(), down.x());
  const Mat2 turn = (Mat2() << down, out).finished();
  scene.blocks.erase(scene.blocks.begin(), scene.blocks.begin() + 2);
  Points slope(2, 4), square(2, 4);
  slope << -20, 20, 20, -20, -2, -2, 0, 0;
  square << -0.5, 0.5, 0.5, -0.5, 0, 0, 1, 1;
  scene.blocks[0].vertices = turn * slope;
  scene.blocks[1].vertices = turn * square;
  return scene;
}

}  // namespace

/// I / (m r^2) = (1 / 6) / (1 / 4) of a square whose corners leave no edge: it rolls like a wheel of that
/// inertia.
TEST(RoundedCorner, ASquareThatIsAlmostADiscRolls) {
  const Scene scene = square_on_a_slope(20, 60, 0.4999, 1);
  const double speed = final_speed(scene, 1, Vec2(std::cos(20 * degree), -std::sin(20 * degree)));
  EXPECT_NEAR(speed, 9.8 * std::sin(20 * degree) * 1 / (5.0 / 3), 2e-3 * speed);
}

TEST(RoundedCorner, ABlockStandsAndSlidesOnItsFaces) {
  const Vec2 down(std::cos(20 * degree), -std::sin(20 * degree));
  for (const double rounding : {0.001, 0.01, 0.1}) {
    EXPECT_NEAR(final_speed(square_on_a_slope(20, 21, rounding, 0.3), 1, down), 0, 1e-6) << rounding;
    const double friction = std::tan(10 * degree),
                 expected = 9.8 * (std::sin(20 * degree) - std::cos(20 * degree) * friction) * 0.3;
    EXPECT_NEAR(final_speed(square_on_a_slope(20, 10, rounding, 0.3), 1, down), expected, 1e-3 * expected)
        << rounding;
  }
}
