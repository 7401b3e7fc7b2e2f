#include <gtest/gtest.h>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/fan_subdivision.hpp>
#include <tests/support/random_polygon.hpp>

#include <set>

using namespace polyfem;

namespace {

class FanSubdivisionTest : public testing::TestWithParam<int> {
 protected:
  const int n = GetParam();
  std::mt19937 random{5};
};

TEST_P(FanSubdivisionTest, TrianglesCoverThePolygonOnceAndAreOfEqualAreaWithinAnEdgesTriangle) {
  for (int corners = 3; corners <= 9; ++corners) {
    const Points outline = support::random_convex_polygon(corners, random);
    const Vec2 centre = area_moments(outline).centroid;
    const FanSubdivision fan = subdivide_fan(outline, centre, n);
    ASSERT_EQ(fan.triangles.cols(), corners * n * n);
    double covered = 0;
    for (Index t = 0; t < fan.triangles.cols(); ++t) {
      const Index edge = t / (n * n);
      const double share =
          cross(outline.col(edge) - centre, outline.col((edge + 1) % corners) - centre) / 2 / (n * n);
      const double area = signed_area(fan.points(Eigen::all, fan.triangles.col(t)));
      EXPECT_NEAR(area, share, 1e-14);
      covered += area;
    }
    EXPECT_NEAR(covered, signed_area(outline), 1e-13);
  }
}

/// An inner edge belongs to two triangles that run along it in opposite senses, so that nothing is left out.
TEST_P(FanSubdivisionTest, NeighboursShareTheirPoints) {
  const Points outline = support::random_convex_polygon(5, random);
  const FanSubdivision fan = subdivide_fan(outline, Vec2(0, 0), n);
  std::set<std::pair<int, int>> sides;
  std::set<int> used;
  for (const auto t : fan.triangles.colwise())
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(sides.emplace(t[k], t[(k + 1) % 3]).second);
      used.insert(t[k]);
    }
  EXPECT_EQ(static_cast<Index>(used.size()), fan.points.cols());
  int on_the_outline = 0;
  for (const auto& [from, to] : sides)
    if (!sides.contains({to, from})) ++on_the_outline;
  EXPECT_EQ(on_the_outline, 5 * n);
}

TEST_P(FanSubdivisionTest, OutlineComesFirstUnchangedAndTheCentreLast) {
  const Points outline = support::random_convex_polygon(6, random);
  const FanSubdivision fan = subdivide_fan(outline, Vec2(0.01, 0.02), n);
  EXPECT_EQ(fan.points.leftCols(6), outline);
  EXPECT_EQ(fan.points.rightCols<1>(), Vec2(0.01, 0.02));
}

INSTANTIATE_TEST_SUITE_P(Pieces, FanSubdivisionTest, testing::Values(1, 2, 3, 10));

}  // namespace
