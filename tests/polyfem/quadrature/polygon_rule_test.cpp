#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/quadrature/polygon_rule.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

class FanRule : public testing::TestWithParam<int> {
 protected:
  std::mt19937 random_{7};
};
INSTANTIATE_TEST_SUITE_P(Vertices, FanRule, testing::Values(3, 4, 5, 8, 20, 100));

TEST_P(FanRule, GivesAreaCentroidAndSecondMoments) {
  PolygonRule rule;
  for (int degree = 2; degree <= 5; ++degree)
    for (int trial = 0; trial < 20; ++trial) {
      const Points polygon = support::random_convex_polygon(GetParam(), random_);
      const AreaMoments exact = area_moments(polygon);
      make_fan_rule(polygon, hammer_rule(degree), rule);
      EXPECT_EQ(rule.points.cols(), GetParam() * hammer_rule(degree).weights.size());
      EXPECT_NEAR(rule.weights.sum(), exact.area, 1e-14);
      EXPECT_LT((rule.points * rule.weights / exact.area - exact.centroid).norm(), 1e-14);
      const Points arms = rule.points.colwise() - exact.centroid;
      EXPECT_LT((arms * rule.weights.asDiagonal() * arms.transpose() - exact.second).norm(), 1e-14);
    }
}

TEST_P(FanRule, ReusesItsStorage) {
  PolygonRule rule;
  make_fan_rule(support::random_convex_polygon(GetParam(), random_), hammer_rule(3), rule);
  const double* storage = rule.points.data();
  make_fan_rule(support::random_convex_polygon(GetParam(), random_), hammer_rule(3), rule);
  EXPECT_EQ(rule.points.data(), storage);
}

TEST(FanRuleOrder, PutsTheCentroidFirstAndTriangleKAtEdgeK) {
  Points square(2, 4);
  square << -1, 1, 1, -1,  //
      -1, -1, 1, 1;
  TriangleRule corners;  // a rule whose points are the corners shows which is which
  corners.points = Eigen::Matrix3d::Identity();
  corners.weights = VectorXd::Constant(3, 1. / 3);
  PolygonRule rule;
  make_fan_rule(square, corners, rule);
  for (Index k = 0; k < 4; ++k) {
    EXPECT_EQ(rule.points.col(3 * k), Vec2(0, 0));
    EXPECT_EQ(rule.points.col(3 * k + 1), square.col(k));
    EXPECT_EQ(rule.points.col(3 * k + 2), square.col((k + 1) % 4));
  }
}

}  // namespace
