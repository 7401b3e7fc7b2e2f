#include <ddacontact/block/rounded_corners.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

TEST(RoundedCorners, TouchBothEdgesAndLeaveSomeOfThem) {
  Points notched(2, 6);
  notched << 0, 2, 2, 1, 1, 0, 0, 0, 1, 1, 2, 2;
  EXPECT_NEAR(largest_rounding(notched).radius, 0.5, 1e-14);
  const RoundedBlock rounded = round_corners(notched, 0.1);
  for (int v = 0; v < 6; ++v) EXPECT_EQ(rounded.corners[v].is_arc, v != 3);
  const auto at = [&](int v) {
    return rounded.corners[v].centre.at(notched.col(v), notched.col((v + 1) % 6));
  };
  EXPECT_NEAR((at(0) - Vec2(0.1, 0.1)).norm(), 0, 1e-15);
  EXPECT_NEAR((at(2) - Vec2(1.9, 0.9)).norm(), 0, 1e-15);
  EXPECT_NEAR((at(3) - Vec2(0.9, 1)).norm(), 0, 1e-15) << "where the edge after it touches it";
}

/// The circle of a corner touches both edges; at the largest radius two circles touch an edge at one place.
TEST(RoundedCorners, CirclesAreAsFarFromBothEdgesAsTheirRadius) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 50; ++trial) {
    const Points outline = support::random_convex_polygon(3 + trial % 5, random);
    const Index n = outline.cols();
    const LargestRounding largest = largest_rounding(outline);
    const RoundedBlock rounded = round_corners(outline, largest.radius);
    const auto at = [&](Index v) -> Vec2 {
      return rounded.corners[static_cast<std::size_t>(v)].centre.at(outline.col(v), outline.col((v + 1) % n));
    };
    for (Index v = 0; v < n; ++v)
      for (const Index e : {v, (v + n - 1) % n}) {
        const Vec2 along = (outline.col((e + 1) % n) - outline.col(e)).normalized();
        EXPECT_NEAR(cross(along, at(v) - outline.col(e)), largest.radius, 1e-14);
        const double s = along.dot(at(v) - outline.col(e));
        EXPECT_TRUE(s > -1e-14 && s < (outline.col((e + 1) % n) - outline.col(e)).norm() + 1e-14);
      }
    EXPECT_NEAR((at(largest.edge) - at((largest.edge + 1) % n)).norm(), 0, 1e-13);
  }
}
