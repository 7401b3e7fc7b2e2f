#include <polyfem/assembly/stress_field.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

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
  EXPECT_LT((field.of_cells.colwise() - exact).norm(), 1e-12);
  EXPECT_LT((field.at_vertices.colwise() - exact).norm(), 1e-12);
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
    EXPECT_LT((field.at_vertices.col(v) - D * Vec3(2 * x.x() - x.y(), 6 * x.y(), -x.x())).norm(), 1e-10);
  }
}

TEST(StressField, RefusesAFieldOfAnotherMesh) {
  EXPECT_THROW(stress_field(mesh, VectorXd::Zero(7), first_order, elasticity), Error);
}

}  // namespace
