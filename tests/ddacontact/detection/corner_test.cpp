#include <ddacontact/detection/corner.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace support;

TEST(Corner, UpToThreeDegreesEitherWayIsStraight) {
  for (const double scale : {1e-6, 1., 1e6})
    for (const double angle : {-170., -90., -3.1, -2.9, 0., 2.9, 3.1, 90., 170., 180.}) {
      const Vec2 before = scale * Vec2(0.6, -0.8),
                 after = 3 * Eigen::Rotation2Dd(radians(angle)).toRotationMatrix() * before;
      EXPECT_EQ(turn_between(before, after), std::abs(angle) < 3 ? Corner::straight
                                             : angle < 0         ? Corner::reflex
                                                                 : Corner::convex)
          << angle;
    }
}

TEST(Corner, OfAnOutlineIsTheTurnAtTheVertex) {
  const Points outline = points({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
  using enum Corner;
  const std::vector<Corner> expected{convex, straight, convex, convex, reflex, convex, convex};
  for (int v = 0; v < 7; ++v) EXPECT_EQ(corner_at(outline, v), expected[static_cast<std::size_t>(v)]) << v;
}

/// Sides of a polygon of 300 turn by 1.2 degrees each: three of them are as good as straight.
TEST(Corner, ARoundOutlineGoesStraightOnForThreeDegrees) {
  const Points circle = regular_polygon(300);
  const double side = 2 * std::sin(std::numbers::pi / 300);
  for (const int from : {0, 150, 298}) {
    EXPECT_TRUE(are_collinear(circle, from, from));
    EXPECT_TRUE(are_collinear(circle, from, (from + 2) % 300));
    EXPECT_FALSE(are_collinear(circle, from, (from + 3) % 300));
    EXPECT_NEAR(straight_length(circle, from, true), 2 * side, 1e-12);
    EXPECT_NEAR(straight_length(circle, from, false), 2 * side, 1e-12);
  }
}

TEST(Corner, StraightLengthIsWhatLiesBeyondTheEnds) {
  const Points outline = points({{0, 0}, {1, 0}, {3, 0}, {6, 0}, {6, 7}, {0, 7}});
  const std::vector<double> beyond{5, 3, 0, 0, 0, 0}, before{0, 1, 3, 0, 0, 0};
  for (int e = 0; e < 6; ++e) {
    EXPECT_EQ(straight_length(outline, e, true), beyond[static_cast<std::size_t>(e)]) << e;
    EXPECT_EQ(straight_length(outline, e, false), before[static_cast<std::size_t>(e)]) << e;
  }
}

TEST(Corner, TurnsLeftByHalfATurnAtMostAndPastNoReflexCorner) {
  const Points square = rectangle(0, 0, 1, 1);
  for (const int from : {0, 3})
    for (int n = 0; n < 4; ++n) EXPECT_EQ(turns_left(square, from, (from + n) % 4), n <= 2) << n;
  const Points notched = points({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  EXPECT_TRUE(turns_left(notched, 0, 2));
  EXPECT_FALSE(turns_left(notched, 2, 3));
  EXPECT_FALSE(turns_left(notched, 1, 3));
  EXPECT_TRUE(turns_left(notched, 3, 5));
}
