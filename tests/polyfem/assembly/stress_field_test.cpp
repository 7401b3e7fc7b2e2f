#include <polyfem/assembly/field_values.hpp>
#include <polyfem/assembly/stress_field.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace polyfem;

namespace {

const Mat3 D = elasticity_matrix(2, 0.2, Plane::strain);
Mat3 elasticity(int) {
  return D;
}
const PolygonMesh mesh = voronoi(support::l_shape(), {.n_cells = 40});

void first_order(int, const PointsRef& cell, TabulatedElement& element) {
  tabulate(cell, dunavant_rule(4), suitable_basis(cell), GradientCorrection::on, element);
}
void second_order(int, const PointsRef& cell, TabulatedElement& element) {
  tabulate_quadratic(cell, dunavant_rule(4), suitable_basis(quadratic_corners(cell)), GradientCorrection::on,
                     element);
}

TEST(StressField, OfALinearFieldIsExactEverywhere) {
  const Mat2 G = (Mat2() << 0.2, 0.5, -0.1, 0.3).finished();
  const StressField field = stress_field(mesh, (G * mesh.vertices).reshaped(), first_order, elasticity);
  const Vec3 exact = D * Vec3(0.2, 0.3, 0.4);
  EXPECT_LT((field.stress.of_cells.colwise() - exact).norm(), 1e-12);
  EXPECT_LT((field.stress.at_points.colwise() - exact).norm(), 1e-12);
  EXPECT_LT((field.stress.at_vertices.colwise() - exact).norm(), 1e-12);
}

TEST(StressField, OfAQuadraticFieldOnQuadraticCellsIsExactAtVertices) {
  const PolygonMesh quadratic = with_edge_midpoints(mesh);
  Points u(2, quadratic.vertices.cols());
  for (Index v = 0; v < u.cols(); ++v) {
    const Vec2 x = quadratic.vertices.col(v);
    u.col(v) << x.x() * x.x() - x.x() * x.y(), 3 * x.y() * x.y();
  }
  const StressField field = stress_field(quadratic, u.reshaped(), second_order, elasticity);
  for (Index v = 0; v < u.cols(); ++v) {
    const Vec2 x = quadratic.vertices.col(v);
    EXPECT_LT((field.stress.at_vertices.col(v) - D * Vec3(2 * x.x() - x.y(), 6 * x.y(), -x.x())).norm(),
              1e-10);
  }
}

TEST(StressField, AtPointsBalancesTheForcesOfTheElements) {
  const Mat3 soft = elasticity_matrix(1, 0.499, Plane::strain);
  VectorXd u(2 * mesh.vertices.cols());
  for (Index k = 0; k < u.size(); ++k) u[k] = std::sin(static_cast<double>(k));
  for (const Dilatation dilatation : {Dilatation::pointwise, Dilatation::mean}) {
    const StressField field = stress_field(
        mesh, u, first_order, [&](int) { return soft; }, dilatation);
    ASSERT_EQ(field.points.cols(), field.first_point.back());
    TabulatedElement element;
    MatrixXd K;
    for (int c = 0; c < mesh.n_cells(); ++c) {
      first_order(c, mesh.outline(c), element);
      if (dilatation == Dilatation::mean)
        b_bar_stiffness(element, soft, K);
      else
        stiffness(element, soft, K);
      const Index first = field.first_point[c], n = field.first_point[c + 1] - first;
      VectorXd forces = VectorXd::Zero(K.rows());
      stress_forces(element, field.stress.at_points.middleCols(first, n), forces);
      EXPECT_LT((forces - K * cell_values(mesh, c, u)).norm(), 1e-11 * K.norm());
      EXPECT_EQ(field.points.col(first), element.rule.points.col(0));
      const auto strain = field.strain.at_points.middleCols(first, n);
      const Eigen::RowVectorXd change = strain.row(0) + strain.row(1);
      if (dilatation == Dilatation::mean) {
        EXPECT_LT(change.maxCoeff() - change.minCoeff(), 1e-12 * strain.norm());
      }
    }
  }
}

TEST(FieldAt, IsTheFieldAndItsGradientAnywhere) {
  const PointLocator locator(mesh);
  const Mat2 G = (Mat2() << 0.2, 0.5, -0.1, 0.3).finished();
  const PolygonMesh quadratic = with_edge_midpoints(mesh);
  const auto squared = [](const Vec2& x) { return x.x() * x.x() - 2 * x.x() * x.y(); };
  VectorXd of_quadratic(quadratic.vertices.cols());
  for (Index v = 0; v < of_quadratic.size(); ++v) of_quadratic[v] = squared(quadratic.vertices.col(v));
  for (const Vec2& x : {Vec2(0.21, 0.33), Vec2(0.5, 0.05), Vec2(0.11, 0.91)}) {
    const FieldAtPoint linear = field_at(mesh, (G * mesh.vertices).reshaped(), locator.nearest(x));
    EXPECT_LT((linear.value - G * x).norm(), 1e-14);
    EXPECT_LT((linear.gradient - G).norm(), 1e-12);
    const FieldAtPoint there =
        field_at(quadratic, of_quadratic, PointLocator(quadratic).nearest(x), CellOrder::quadratic);
    EXPECT_NEAR(there.value[0], squared(x), 1e-13);
    EXPECT_LT((there.gradient - Eigen::RowVector2d(2 * x.x() - 2 * x.y(), -2 * x.x())).norm(), 1e-11);
  }
  EXPECT_THROW(cell_values(mesh, mesh.n_cells(), VectorXd::Zero(mesh.vertices.cols())), Error);
  EXPECT_THROW(cell_values(mesh, 0, VectorXd::Zero(mesh.vertices.cols() + 1)), Error);
}

TEST(StressField, RefusesAFieldOfAnotherMesh) {
  EXPECT_THROW(stress_field(mesh, VectorXd::Zero(7), first_order, elasticity), Error);
}

}  // namespace
