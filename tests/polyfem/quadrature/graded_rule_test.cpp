#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/quadrature/graded_rule.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/direct_mean_value.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

/// The squared gradients of all shape functions, integrated.
double energy(const Points& polygon, const PolygonRule& rule, const Basis& basis) {
  ShapeTable shape;
  basis.evaluate(polygon, rule.points, shape);
  return rule.weights.dot(shape.dx.rowwise().squaredNorm() + shape.dy.rowwise().squaredNorm());
}

void expect_points_inside(const Points& polygon, const PolygonRule& rule, const std::string& name) {
  EXPECT_GT(rule.weights.minCoeff(), 0) << name;
  for (Index q = 0; q < rule.weights.size(); ++q) EXPECT_TRUE(contains(polygon, rule.points.col(q))) << name;
}

/// Vertex 0 cut off, which leaves an edge there.
Points cut_corner(const Points& polygon, double length) {
  const Index n = polygon.cols();
  const Vec2 vertex = polygon.col(0);
  Points cut(2, n + 1);
  cut.rightCols(n) = polygon;
  cut.col(0) = vertex + length * (polygon.col(n - 1) - vertex).normalized();
  cut.col(1) = vertex + length * (polygon.col(1) - vertex).normalized();
  return cut;
}

Points with_short_edge(int n, double length) {
  return cut_corner(support::regular_polygon(n - 1), length);
}

class AdjointRule : public testing::TestWithParam<int> {
 protected:
  int n_ = GetParam();
  std::mt19937 random_{static_cast<unsigned>(n_)};
  PolygonRule rule_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, AdjointRule, testing::Values(4, 5, 6, 8, 12, 20));

TEST_P(AdjointRule, HasPositiveWeightsAndPointsInside) {
  for (const double digits : {4., 12., 30.}) {
    const Points polygon = support::random_convex_polygon(n_, random_);
    make_adjoint_rule(polygon, digits, rule_);
    expect_points_inside(polygon, rule_, "");
  }
}

TEST_P(AdjointRule, ConvergesExponentiallyHoweverShortAnEdge) {
  for (const double length : {0.3, 1e-2, 1e-4, 1e-6}) {
    const Points polygon = with_short_edge(n_, length);
    make_adjoint_rule(polygon, 40, rule_);
    const double exact = energy(polygon, rule_, wachspress);
    for (const double digits : {6., 12., 18., 24.}) {
      make_adjoint_rule(polygon, digits, rule_);
      const double error = std::abs(energy(polygon, rule_, wachspress) / exact - 1);
      EXPECT_LT(error, 20 * std::exp(-0.87 * digits)) << length << ", " << digits;
    }
  }
}

TEST_P(AdjointRule, ConvergesExponentiallyWherePolesLieAtAllDistances) {
  Points polygon = support::regular_polygon(n_);
  for (const double length : {1e-1, 1e-2, 1e-3, 1e-4}) polygon = cut_corner(polygon, length);
  make_adjoint_rule(polygon, 40, rule_);
  const double exact = energy(polygon, rule_, wachspress);
  for (const double digits : {12., 18., 24.}) {
    make_adjoint_rule(polygon, digits, rule_);
    EXPECT_LT(std::abs(energy(polygon, rule_, wachspress) / exact - 1), std::exp(-0.87 * digits)) << digits;
  }
}

TEST_P(AdjointRule, TakesPointsWithTheLogarithmOfTheShortestEdge) {
  make_adjoint_rule(with_short_edge(n_, 1e-2), 20, rule_);
  const Index n_points = rule_.weights.size();
  make_adjoint_rule(with_short_edge(n_, 1e-4), 20, rule_);
  EXPECT_LT(rule_.weights.size(), 2 * n_points);
}

TEST(VertexRule, FillsConcavePolygonsWithPositiveWeights) {
  PolygonRule rule;
  for (const auto& [name, polygon] : support::concave_polygons()) {
    make_vertex_rule(polygon, 20, rule);
    expect_points_inside(polygon, rule, name);
    EXPECT_NEAR(rule.weights.sum() / signed_area(polygon), 1, 1e-8) << name;
  }
}

TEST(VertexRule, ConvergesExponentiallyForMeanValueFunctions) {
  PolygonRule rule;
  for (const auto& [name, polygon] : support::concave_polygons()) {
    make_vertex_rule(polygon, 34, rule);
    const double exact = energy(polygon, rule, support::DirectMeanValue());
    for (const double digits : {8., 14., 20.}) {
      make_vertex_rule(polygon, digits, rule);
      const double error = std::abs(energy(polygon, rule, support::DirectMeanValue()) / exact - 1);
      EXPECT_LT(error, 20 * std::exp(-digits)) << name << ", " << digits;
    }
  }
}

/// Next to a vertex of coordinate 1 points 1e-17 apart are the same.
TEST(VertexRule, IsFiniteHoweverShortAnEdge) {
  PolygonRule rule;
  for (const double length : {1e-4, 1e-8, 1e-12}) {
    const Points polygon = support::points({{0, 0}, {1, 0}, {1, 1}, {length, 1}, {0, 1 - length}});
    for (const double digits : {20., 42.}) {
      make_vertex_rule(polygon, digits, rule);
      EXPECT_TRUE(rule.points.allFinite() && rule.weights.allFinite());
      EXPECT_NEAR(rule.weights.sum(), signed_area(polygon), 1e-8);
    }
  }
}

/// Straight corners turned by an angle are so up to round-off: an ear of no area may lie across one, with the
/// straight vertex at the middle of its side.
TEST(VertexRule, IsFiniteAtStraightCornersHoweverTurned) {
  PolygonRule rule;
  const Points U = support::concave_polygons()[6].points;
  for (double angle = 0; angle < 6.2; angle += 0.05) {
    Mat2 R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const Points turned = R * U;
    make_vertex_rule(turned, 6, rule);
    ASSERT_TRUE(rule.points.allFinite() && rule.weights.allFinite()) << angle;
    EXPECT_NEAR(rule.weights.sum() / signed_area(turned), 1, 1e-3) << angle;
  }
}

}  // namespace
