#include <polyfem/geometry/area_moments.hpp>
#include <tests/support/domains.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;
using support::l_shape;
using support::rectangle;

namespace {

TEST(AreaMoments, OfRectangleAreTheTextbookOnes) {
  const AreaMoments moments = area_moments(rectangle(3, 2));
  EXPECT_DOUBLE_EQ(moments.area, 6);
  EXPECT_TRUE(moments.centroid.isApprox(Vec2(1.5, 1), 1e-15));
  EXPECT_NEAR(moments.second(0, 0), 2 * 27 / 12., 1e-14);
  EXPECT_NEAR(moments.second(1, 1), 3 * 8 / 12., 1e-14);
  EXPECT_NEAR(moments.second(0, 1), 0, 1e-14);
}

TEST(AreaMoments, OfConcavePolygonAreTheSumOfItsParts) {
  const AreaMoments moments = area_moments(l_shape());
  const Vec2 centres[] = {{0.5, 0.5}, {1.5, 0.5}, {0.5, 1.5}};
  Mat2 second = Mat2::Identity() * 3 / 12;
  for (const Vec2& centre : centres) {
    const Vec2 arm = centre - Vec2(5, 5) / 6;
    second += arm * arm.transpose();
  }
  EXPECT_DOUBLE_EQ(moments.area, 3);
  EXPECT_TRUE(moments.centroid.isApprox(Vec2(5, 5) / 6, 1e-15));
  EXPECT_TRUE(moments.second.isApprox(second, 1e-14));
}

TEST(AreaMoments, ClockwiseOrderTurnsTheSignButKeepsTheCentroid) {
  const AreaMoments forward = area_moments(l_shape());
  const AreaMoments backward = area_moments(l_shape().rowwise().reverse());
  EXPECT_DOUBLE_EQ(backward.area, -forward.area);
  EXPECT_TRUE(backward.centroid.isApprox(forward.centroid, 1e-15));
  EXPECT_TRUE(backward.second.isApprox(-forward.second, 1e-14));
}

class AreaMomentsOfRandomPolygons : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Vertices, AreaMomentsOfRandomPolygons, testing::Values(3, 4, 7, 20, 100));

TEST_P(AreaMomentsOfRandomPolygons, FollowAffineMaps) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Points polygon = support::random_convex_polygon(GetParam(), random);
    Mat2 A;
    A << 1.5, 0.4, -0.3, 0.8;
    const Points mapped = (A * polygon).colwise() + Vec2(0.3, -0.7);
    const AreaMoments before = area_moments(polygon), after = area_moments(mapped);
    const double determinant = cross(A.col(0), A.col(1));
    EXPECT_NEAR(after.area, determinant * before.area, 1e-14);
    EXPECT_LT((after.centroid - (A * before.centroid + Vec2(0.3, -0.7))).norm(), 1e-14);
    EXPECT_LT((after.second - determinant * A * before.second * A.transpose()).norm(), 1e-14);
  }
}

TEST_P(AreaMomentsOfRandomPolygons, DoNotLoseDigitsFarFromTheOrigin) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec2 offset(1e8, -3e7);
    const Points far = support::random_convex_polygon(GetParam(), random).colwise() + offset;
    const Points near = far.colwise() - offset;  // the same rounded vertices: the difference is exact
    const AreaMoments here = area_moments(near), there = area_moments(far);
    EXPECT_NEAR(there.area, here.area, 1e-15);
    EXPECT_LT((there.second - here.second).norm(), 1e-15);
    EXPECT_LT((there.centroid - offset - here.centroid).norm(), 2e-8);  // one rounding at 1e8
    EXPECT_EQ(signed_area(far), there.area);
  }
}

}  // namespace
