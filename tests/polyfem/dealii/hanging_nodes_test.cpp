// Hanging nodes as vertices: linear fields pass, on squares, on curved cells whose hanging nodes are off the
// line, and on triangles.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/dealii/triangulation_mesh.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/polyfem/dealii/refined_triangulation.hpp>

#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

Vec2 linear_displacement(const Vec2& x) {
  return {0.3 + 0.01 * x.x() - 0.02 * x.y(), -0.1 + 0.03 * x.x() + 0.02 * x.y()};
}

/// Displacements held on the boundary find the linear field inside, with 4 points a triangle.
void expect_patch_test(const dealii::Triangulation<2>& triangulation) {
  const TriangulationMesh mesh = polygon_mesh(triangulation);
  FieldProblem problem(mesh, 2);
  TabulatedElement element;
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
    tabulate(polygon, hammer_rule(3), suitable_basis(polygon), GradientCorrection::on, element);
    stiffness(element, D, K);
  });
  for (const BoundaryLine& line : mesh.boundary)
    for (const int component : {0, 1})
      problem.hold(line.vertices[0], component,
                   linear_displacement(mesh.vertices.col(line.vertices[0]))[component]);
  const VectorXd& d = problem.solve();
  for (Index i = 0; i < mesh.vertices.cols(); ++i)
    EXPECT_LT((d.segment<2>(2 * i) - linear_displacement(mesh.vertices.col(i))).norm(), 1e-12);
  EXPECT_GT(mesh.vertices.cols(), static_cast<Index>(mesh.boundary.size()) + 20);
}

class HangingNodes : public testing::TestWithParam<int> {
 protected:
  std::mt19937 random{static_cast<unsigned>(GetParam())};
  dealii::Triangulation<2> triangulation;
};
INSTANTIATE_TEST_SUITE_P(Seeds, HangingNodes, testing::Range(1, 6));

TEST_P(HangingNodes, OfSquaresPassThePatchTest) {
  dealii::GridGenerator::hyper_L(triangulation);
  support::refine_randomly(triangulation, 5, random);
  expect_patch_test(triangulation);
}

TEST_P(HangingNodes, OfCurvedCellsPassThePatchTest) {
  dealii::GridGenerator::hyper_shell(triangulation, dealii::Point<2>(), 1, 2, 5);
  support::refine_randomly(triangulation, 5, random);
  expect_patch_test(triangulation);
}

TEST_P(HangingNodes, OfTrianglesPassThePatchTest) {
  dealii::GridGenerator::subdivided_hyper_cube_with_simplices(triangulation, 4);
  support::refine_randomly(triangulation, 2, random);
  expect_patch_test(triangulation);
}

}  // namespace
