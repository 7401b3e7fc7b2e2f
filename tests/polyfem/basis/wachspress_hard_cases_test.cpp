// Polygons on which the usual formulas lose digits or divide by zero: nearly straight corners, many vertices.
#include <polyfem/basis/wachspress.hpp>
#include <tests/support/exact_shape_functions.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

void expect_round_off(const Points& polygon, const std::vector<Vec2>& points) {
  const Points columns =
      Eigen::Map<const Points>(points.front().data(), 2, static_cast<Index>(points.size()));
  ShapeTable table;
  wachspress.evaluate(polygon, columns, table);
  for (Index q = 0; q < columns.cols(); ++q) {
    const auto errors = support::shape_errors(table, q, support::exact_wachspress(polygon, columns.col(q)));
    EXPECT_LT(errors.value, 1e-14) << "at " << columns.col(q).transpose();
    EXPECT_LT(errors.gradient, 1e-14) << "at " << columns.col(q).transpose();
  }
}

/// One at a vertex but for the rounding of a division, exact zeros elsewhere.
void expect_unit(const VectorXd& values, Index vertex) {
  EXPECT_NEAR(values[vertex], 1, 2.3e-16);
  EXPECT_EQ((values.array() != 0).count(), 1);
}

class WachspressNearStraightCorner : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Turn, WachspressNearStraightCorner, testing::Values(1e-2, 1e-4, 1e-6, 1e-8, 1e-10));

TEST_P(WachspressNearStraightCorner, IsExactAtTheCornerItself) {
  const double turn = GetParam();
  Points polygon(2, 5);
  polygon << 0, 0.5, 1, 1, 0,  //
      0, -turn / 4, 0, 1, 1;
  ShapeValues shape;
  wachspress(polygon, polygon.col(1), shape);
  expect_unit(shape.values, 1);
  EXPECT_NEAR(shape.gradients(1, 1), -4 / turn, 4e-15 / turn);  // linear triangle of height turn / 4
  EXPECT_NEAR(shape.gradients(1, 0), 2 / turn, 4e-15 / turn);
  EXPECT_NEAR(shape.gradients(1, 2), 2 / turn, 4e-15 / turn);
}

class WachspressManyVertices : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Vertices, WachspressManyVertices, testing::Values(100, 200, 400, 1000));

TEST_P(WachspressManyVertices, NeitherOverflowsNorUnderflows) {
  const int n = GetParam();
  for (const double size : {1e-9, 1., 1e9}) {
    const Points polygon = size * support::regular_polygon(n);
    std::vector<Vec2> points{Vec2::Zero()};
    for (const double s : {0., 0.3, 1e-9, 1 - 1e-6}) {
      points.push_back(polygon.col(0) + s * (polygon.col(1) - polygon.col(0)));  // vertex and edge
      points.push_back(s * polygon.col(n / 3));                                  // a radius
    }
    expect_round_off(polygon, points);
    ShapeValues shape;
    wachspress(polygon, polygon.col(n / 2), shape);
    expect_unit(shape.values, n / 2);
  }
}

TEST_P(WachspressManyVertices, OfARegularPolygonIsEqualAtTheCentre) {
  const int n = GetParam();
  ShapeValues shape;
  const Points polygon = support::regular_polygon(n);
  wachspress(polygon, Vec2::Zero(), shape);
  // The vertices are rounded: the corners' areas (2 pi / n)^3 are known to about 1e-16, so N to 4e-19 n^2.
  const double tolerance = 1e-15 + 4e-19 * n * n;
  EXPECT_LT((shape.values.array() - 1. / n).abs().maxCoeff(), tolerance);
  // by symmetry grad N_i points to v_i, and sum v_i grad N_i^T = I makes its length 2 / n
  EXPECT_LT((shape.gradients - 2. / n * polygon).cwiseAbs().maxCoeff(), 10 * tolerance);
}

}  // namespace
