#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/core/error.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/domains.hpp>
#include <tests/support/quadratic_cells.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace polyfem;

namespace {

/// A quadratic cell, the basis for it and points inside.
struct Cell {
  Points nodes, inside;
  const Basis* basis;
};

/// Halfway from the centroid of three consecutive corners to their middle one: inside if that is convex.
Points points_inside(const Points& polygon) {
  std::vector<Vec2> points;
  const Index n = polygon.cols();
  for (Index k = 0; k < n; ++k) {
    const Vec2 a = polygon.col((k + n - 1) % n), b = polygon.col(k), c = polygon.col((k + 1) % n);
    if (cross(b - a, c - b) > 0) points.push_back(0.9 * b + 0.05 * (a + c));
  }
  return Eigen::Map<const Points>(points[0].data(), 2, static_cast<Index>(points.size()));
}

std::vector<Cell> cells() {
  std::vector<Cell> cells;
  std::mt19937 random(7);
  for (int n = 3; n <= 12; ++n) {
    const Points polygon = support::random_convex_polygon(n, random);
    for (const Basis* basis :
         {static_cast<const Basis*>(&wachspress), static_cast<const Basis*>(&mean_value)})
      cells.push_back({support::with_middles(polygon), points_inside(polygon), basis});
  }
  for (const auto& [name, polygon] : support::concave_polygons())
    cells.push_back({support::with_middles(polygon), points_inside(polygon), &mean_value});
  return cells;
}

/// A row of 1, x, y, x^2, x y, y^2 and its derivatives for each point.
Eigen::MatrixX<double> monomials(const Points& points, int derivative_by = -1) {
  MatrixXd p(points.cols(), 6);
  for (Index q = 0; q < points.cols(); ++q) {
    const double x = points(0, q), y = points(1, q);
    if (derivative_by < 0) p.row(q) << 1, x, y, x * x, x * y, y * y;
    if (derivative_by == 0) p.row(q) << 0, 1, 0, 2 * x, y, 0;
    if (derivative_by == 1) p.row(q) << 0, 0, 1, 0, x, 2 * y;
  }
  return p;
}

TEST(QuadraticShapes, ReproduceQuadraticPolynomialsAndTheirGradients) {
  ShapeTable table;
  for (const Cell& cell : cells()) {
    evaluate_quadratic(cell.nodes, *cell.basis, cell.inside, table);
    const MatrixXd at_nodes = monomials(cell.nodes);
    EXPECT_LT((table.values * at_nodes - monomials(cell.inside)).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT((table.dx * at_nodes - monomials(cell.inside, 0)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((table.dy * at_nodes - monomials(cell.inside, 1)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(QuadraticShapes, AreOneAtTheirNodeAndZeroAtTheOthers) {
  ShapeTable table;
  for (const Cell& cell : cells()) {
    evaluate_quadratic(cell.nodes, *cell.basis, cell.nodes, table);
    EXPECT_LT((table.values - MatrixXd::Identity(cell.nodes.cols(), cell.nodes.cols())).norm(), 1e-11);
  }
}

TEST(QuadraticShapes, OnAnEdgeAreThoseOfItsThreeNodes) {
  ShapeTable table;
  const double t = 0.3;
  for (const Cell& cell : cells())
    for (Index k = 0; k < cell.nodes.cols(); k += 2) {
      const Index last = (k + 2) % cell.nodes.cols();
      const Vec2 x = (1 - t) * cell.nodes.col(k) + t * cell.nodes.col(last);
      evaluate_quadratic(cell.nodes, *cell.basis, x, table);
      VectorXd expected = VectorXd::Zero(cell.nodes.cols());
      expected[k] = (1 - t) * (1 - 2 * t);
      expected[k + 1] = 4 * t * (1 - t);
      expected[last] = t * (2 * t - 1);
      EXPECT_LT((table.values.row(0).transpose() - expected).norm(), 1e-11);
    }
}

TEST(QuadraticShapes, HaveTheGradientsThatDifferencesHave) {
  const double step = 1e-5;
  ShapeTable table, ahead, behind;
  for (const Cell& cell : cells()) {
    evaluate_quadratic(cell.nodes, *cell.basis, cell.inside, table);
    for (const int axis : {0, 1}) {
      const Points shift = (step * Vec2::Unit(axis)).replicate(1, cell.inside.cols());
      evaluate_quadratic(cell.nodes, *cell.basis, cell.inside + shift, ahead);
      evaluate_quadratic(cell.nodes, *cell.basis, cell.inside - shift, behind);
      const MatrixXd differences = (ahead.values - behind.values) / (2 * step);
      const MatrixXd& slopes = axis == 0 ? table.dx : table.dy;
      EXPECT_LT((differences - slopes).norm(), 1e-5 * (1 + slopes.norm()));
    }
  }
}

TEST(QuadraticShapes, OfAParallelogramAreThoseOfTheEightNodeQuadrilateral) {
  const Mat2 map = (Mat2() << 3, 0.7, -0.4, 0.2).finished();
  const Points square = support::polygon_of({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  const Points nodes = support::with_middles(square);
  ShapeTable table;
  const Vec2 x(0.3, -0.6);
  evaluate_quadratic((map * nodes).eval(), wachspress, (map * x).eval(), table);
  for (Index k = 0; k < 8;
       ++k) {  // Zienkiewicz and Taylor: corners, middles of horizontal and vertical sides
    const double a = nodes(0, k), b = nodes(1, k);
    const double expected = k % 2 == 0 ? (1 + a * x.x()) * (1 + b * x.y()) * (a * x.x() + b * x.y() - 1) / 4
                            : a == 0   ? (1 - x.x() * x.x()) * (1 + b * x.y()) / 2
                                       : (1 + a * x.x()) * (1 - x.y() * x.y()) / 2;
    EXPECT_NEAR(table.values(0, k), expected, 1e-13);
  }
}

TEST(QuadraticShapes, DoNotDependOnAffineMapsAndFarOrigins) {
  std::mt19937 random(3);
  const Points polygon = support::random_convex_polygon(7, random), inside = points_inside(polygon);
  const Mat2 map = (Mat2() << 1000, 3, 2, 0.1).finished();
  const Vec2 shift(1e4, -2e4);
  ShapeTable table, mapped;
  evaluate_quadratic(support::with_middles(polygon), wachspress, inside, table);
  evaluate_quadratic(support::with_middles((map * polygon).colwise() + shift), wachspress,
                     (map * inside).colwise() + shift, mapped);
  EXPECT_LT((mapped.values - table.values).norm(), 1e-6) << "an aspect of 1e4 and coordinates of 1e5";
  evaluate_quadratic(support::with_middles(map * polygon), wachspress, map * inside, mapped);
  EXPECT_LT((mapped.values - table.values).norm(), 1e-9);
}

TEST(QuadraticShapes, RefuseCellsWithoutMidpoints) {
  ShapeTable table;
  Points cell = support::with_middles(support::rectangle(1, 1));
  EXPECT_THROW(evaluate_quadratic(cell.leftCols(7), wachspress, Vec2(0.5, 0.5), table), Error);
  cell(0, 3) += 0.01;
  try {
    evaluate_quadratic(cell, wachspress, Vec2(0.5, 0.5), table);
    FAIL() << "node 3 is off its edge";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("node 3"), std::string::npos) << error.what();
  }
}

}  // namespace
