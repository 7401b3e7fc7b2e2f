// Elements with vertices on edges and concave corners: mean value functions keep them at full rank.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/element/definiteness.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

/// A polygon and triangles of its vertices that fill it.
struct Shape {
  Points polygon;
  std::vector<std::array<int, 3>> triangles;
};

PolygonRule fine_rule(const Shape& shape) {
  const TriangleRule on_triangle = collapsed_gauss_rule(10, 10);
  const Index n = on_triangle.weights.size(), n_triangles = static_cast<Index>(shape.triangles.size());
  PolygonRule rule{Points(2, n * n_triangles), VectorXd(n * n_triangles)};
  for (Index k = 0; k < n_triangles; ++k) {
    const auto& [a, b, c] = shape.triangles[static_cast<std::size_t>(k)];
    Points corners(2, 3);
    corners << shape.polygon.col(a), shape.polygon.col(b), shape.polygon.col(c);
    const double area = cross(corners.col(1) - corners.col(0), corners.col(2) - corners.col(0)) / 2;
    rule.points.middleCols(k * n, n) = corners * on_triangle.points;
    rule.weights.segment(k * n, n) = area * on_triangle.weights;
  }
  return rule;
}

struct ElementMatrices {
  MatrixXd K, M;
};

ElementMatrices matrices(const Points& polygon, const PolygonRule& rule) {
  TabulatedElement element;
  ElementMatrices result;
  tabulate(polygon, rule, mean_value, GradientCorrection::on, element);
  stiffness(element, elasticity_matrix(1, 0.3, Plane::strain), result.K);
  mass(element, result.M);
  return result;
}

void expect_sound(const ElementMatrices& element) {
  const Definiteness definiteness = judge(element.K, element.M);
  EXPECT_TRUE(definiteness.definite());
  EXPECT_EQ(definiteness.zero_modes, 3);
  EXPECT_LE(1 / definiteness.least_stiffness, 20);
  testing::Test::RecordProperty("condition", testing::PrintToString(1 / definiteness.least_stiffness));
}

class VertexNearAnEdge : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Distance, VertexNearAnEdge, testing::Values(1e-3, 1e-6, 1e-12, 0, -1e-12, -1e-3));

/// Wachspress functions would give this vertex a stiffness of 0.122 / distance, and coarse rules none at all.
TEST_P(VertexNearAnEdge, IsAsStiffAsOthers) {
  Points square(2, 5);
  square << 0, 0.5, 1, 1, 0,  //
      0, -GetParam(), 0, 1, 1;
  PolygonRule rule;
  make_fan_rule(square, collapsed_gauss_rule(10, 10), rule);
  const ElementMatrices element = matrices(square, rule);
  expect_sound(element);
  EXPECT_NEAR(element.K(3, 3), 1, 0.02);
}

TEST(MeanValueElement, IsSoundOnASquareWithVerticesInTheMiddleOfItsEdges) {
  Points square(2, 8);
  square << 0, 1, 2, 2, 2, 1, 0, 0,  //
      0, 0, 0, 1, 2, 2, 2, 1;
  PolygonRule rule;
  make_fan_rule(square, collapsed_gauss_rule(10, 10), rule);
  expect_sound(matrices(square, rule));
}

TEST(MeanValueElement, IsSoundOnConcaveShapes) {
  Points dart(2, 4), l_shape(2, 6), notch(2, 7);
  dart << 0, 1, 0, 0.25,  //
      0, 0, 1, 0.25;
  l_shape << 0, 2, 2, 1, 1, 0,  //
      0, 0, 1, 1, 2, 2;
  notch << 0, 2, 2, 1.1, 1, 0.9, 0,  //
      0, 0, 2, 2, 0.5, 2, 2;
  for (const Shape& shape :
       {Shape{dart, {{0, 1, 3}, {0, 3, 2}}}, Shape{l_shape, {{3, 0, 1}, {3, 1, 2}, {3, 4, 5}, {3, 5, 0}}},
        Shape{notch, {{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {4, 5, 6}, {4, 6, 0}}}}) {
    SCOPED_TRACE(shape.polygon);
    expect_sound(matrices(shape.polygon, fine_rule(shape)));
  }
}

}  // namespace
