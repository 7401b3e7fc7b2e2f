#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/quadrature/polygon_rule.hpp>
#include <tests/support/concave_polygons.hpp>
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

/// How far the rule is from the polygon's area, centroid and second moments.
double moment_error(const PolygonRule& rule, const Points& polygon) {
  const AreaMoments exact = area_moments(polygon);
  const Points arms = rule.points.colwise() - exact.centroid;
  return std::abs(rule.weights.sum() - exact.area) + (arms * rule.weights).norm() +
         (arms * rule.weights.asDiagonal() * arms.transpose() - exact.second).norm();
}

TEST(EarRule, GivesAreaCentroidAndSecondMomentsOfConcavePolygons) {
  PolygonRule rule;
  for (const auto& [name, polygon] : support::concave_polygons()) {
    make_ear_rule(polygon, dunavant_rule(2), rule);
    EXPECT_EQ(rule.weights.size(), 3 * (polygon.cols() - 2)) << name;
    EXPECT_LT(moment_error(rule, polygon), 1e-13) << name;
    EXPECT_GT(rule.weights.minCoeff(), 0) << name;
  }
}

TEST(PolygonRules, AreFansWhereThePolygonIsStarShapedAboutItsCentroidAndEarsOtherwise) {
  PolygonRule rule, fan;
  for (const auto& [name, polygon] : support::concave_polygons()) {
    make_polygon_rule(polygon, dunavant_rule(2), rule);
    EXPECT_LT(moment_error(rule, polygon), 1e-13) << name;
    EXPECT_GT(rule.weights.minCoeff(), 0) << name;
    const bool star = is_star_shaped(polygon, area_moments(polygon).centroid);
    EXPECT_EQ(rule.weights.size(), 3 * (polygon.cols() - (star ? 0 : 2))) << name;
  }
  std::mt19937 random(1);
  const Points convex = support::random_convex_polygon(9, random);
  make_polygon_rule(convex, hammer_rule(3), rule);
  make_fan_rule(convex, hammer_rule(3), fan);
  EXPECT_EQ(rule.points, fan.points);
  EXPECT_EQ(rule.weights, fan.weights);
}

TEST(QuadrilateralRule, IntegratesWhatIsAPolynomialOfThePlane) {
  std::mt19937 random(2);
  PolygonRule rule;
  for (int trial = 0; trial < 20; ++trial) {
    const Points quadrilateral = support::random_convex_polygon(4, random);
    make_quadrilateral_rule(quadrilateral, 2, rule);  // x x^T and the determinant: degree 3 along a side
    EXPECT_EQ(rule.weights.size(), 4);
    EXPECT_GT(rule.weights.minCoeff(), 0);
    EXPECT_LT(moment_error(rule, quadrilateral), 1e-14);
  }
}

TEST(IsStarShaped, IsNoPolygonWithAVertexThatIsNotFinite) {
  Points square = support::regular_polygon(4);
  square(0, 2) = std::nan("");
  EXPECT_FALSE(is_star_shaped(square, Vec2::Zero()));
}

}  // namespace
