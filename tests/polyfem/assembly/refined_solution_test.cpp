// Factors in single precision, and solutions in double precision by them.
#include <polyfem/assembly/elimination_order.hpp>
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/assembly/refined_solution.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>
#include <tests/support/grid_laplacian.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace polyfem;

namespace {

/// A beam of Voronoi cells, held at its left end, under its weight.
struct Beam {
  Beam(double length, int n_cells)
      : mesh(voronoi(support::rectangle(length, 1), {.n_cells = n_cells})), problem(mesh, 2) {
    const Mat3 D = elasticity_matrix(3e10, 0.3, Plane::strain);
    TabulatedElement element;
    problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
      tabulate(polygon, dunavant_rule(3), suitable_basis(polygon), GradientCorrection::on, element);
      stiffness(element, D, K);
      for (Index i = 0; i < polygon.cols(); ++i) f[2 * i + 1] = -1e4 * element.area / double(polygon.cols());
    });
    for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.x() == 0; }))
      for (const int axis : {0, 1}) problem.hold(v, axis);
  }

  /// By a factor in double precision of the rows and columns that are not held.
  VectorXd solution_in_double_precision() {
    SparseMatrix lower = problem.matrix();
    PrescribedDofs held(problem.n_unknowns());
    for (int k = 0; k < problem.n_unknowns(); ++k)
      if (problem.is_prescribed(k)) held.hold(k, 0);
    held.take_out(lower);
    VectorXd f = problem.loads(), u;
    held.move_to_right_hand_side(f);
    Cholesky cholesky;
    cholesky.analyze(lower);
    EXPECT_TRUE(cholesky.factorize(lower));
    cholesky.solve(f, u);
    return u;
  }

  PolygonMesh mesh;
  FieldProblem problem;
};

double relative_difference(const VectorXd& a, const VectorXd& b) {
  return (a - b).norm() / b.norm();
}

TEST(RefinedSolution, IsThatOfDoublePrecision) {
  Beam beam(2, 8000);
  const VectorXd u = beam.problem.solve();
  EXPECT_LT(relative_difference(u, beam.solution_in_double_precision()), 1e-12);
}

TEST(RefinedSolution, GivesWayToDoublePrecisionForManyRightHandSides) {
  Beam beam(2, 8000);
  const VectorXd first = beam.problem.solve();
  EXPECT_EQ(beam.problem.n_factorizations(), 1);
  for (int k = 0; k < 10; ++k) EXPECT_LT(relative_difference(beam.problem.solve(), first), 1e-12);
  EXPECT_EQ(beam.problem.n_factorizations(), 2);
  EXPECT_EQ(beam.problem.n_analyses(), 1);
}

TEST(RefinedSolution, OfASlenderBeamIsLeftToDoublePrecision) {
  Beam beam(60, 8000);
  const VectorXd u = beam.problem.solve();
  EXPECT_LT(relative_difference(u, beam.solution_in_double_precision()), 1e-8);
}

class RoughFactor : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Unit, RoughFactor, testing::Values(1e-30, 1., 1e30));

TEST_P(RoughFactor, SolvesInAnyUnitWithHalfOfTheMemory) {
  const SparseMatrix K = GetParam() * support::grid_laplacian(300, 0.1);
  const VectorXd b = VectorXd::LinSpaced(K.rows(), -1, 1);
  Cholesky rough, exact;
  rough.dissect(K);
  exact.dissect(K);
  ASSERT_TRUE(rough.factorize_roughly(K));
  ASSERT_TRUE(exact.factorize(K));
  EXPECT_LT(rough.memory(), 0.7 * exact.memory());
  VectorXd x, x_exact;
  ASSERT_TRUE(refined_solution(K, rough, b, x));
  exact.solve(b, x_exact);
  EXPECT_LT(relative_difference(x, x_exact), 1e-13);
  ASSERT_TRUE(refined_solution(K, rough, VectorXd::Zero(b.size()), x));
  EXPECT_TRUE(x.isZero(0));
}

TEST(RoughFactors, IsNotMadeOfMatricesThatAreNotDefiniteOrNearlySo) {
  SparseMatrix K = support::grid_laplacian(500, -1);
  Cholesky rough;
  rough.dissect(K);
  EXPECT_FALSE(rough.factorize_roughly(K));
  EXPECT_FALSE(rough.factorize_roughly(support::grid_laplacian(500, -2e-4)))
      << "the last pivots are negative";
  EXPECT_FALSE(rough.factorize_roughly(support::grid_laplacian(500, -5))) << "the diagonal is negative";
  K = support::grid_laplacian(500, 0.1);
  EXPECT_TRUE(rough.factorize_roughly(K)) << "afterwards it is as it was";
}

TEST(EliminationOrder, HasAllVerticesAndLeavesAsFewEntriesAsMinimumDegree) {
  for (const int n_cells : {400, 40000}) {
    const PolygonMesh mesh = voronoi(support::rectangle(2, 1), {.n_cells = n_cells});
    MeshMatrix matrix(mesh, 1);
    const std::vector<int> order =
        elimination_order(mesh, VertexCells(mesh), matrix.first_neighbours(), matrix.neighbours());
    std::vector<int> sorted = order;
    std::ranges::sort(sorted);
    std::vector<int> all(sorted.size());
    std::iota(all.begin(), all.end(), 0);
    ASSERT_EQ(sorted, all);
    Cholesky dissected, by_degree;
    dissected.analyze(matrix.lower(), order);
    by_degree.analyze(matrix.lower(), minimum_degree_order(matrix.first_neighbours(), matrix.neighbours()));
    EXPECT_LE(dissected.n_factor_entries(), (n_cells > 1000 ? 1.01 : 1) * by_degree.n_factor_entries());
  }
}

}  // namespace
