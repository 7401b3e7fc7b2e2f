#include <polyfem/assembly/nonlinear_problem.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/finite_strain.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <random>

using namespace polyfem;

namespace {

constexpr double lambda = 2, mu = 1;
FiniteStress material(Index, const Mat2& F) {
  return neo_hooke(lambda, mu, F);
}

void first_order(int, const PointsRef& cell, const VectorXd& u, MatrixXd& K, VectorXd& forces) {
  TabulatedElement element;
  tabulate(cell, dunavant_rule(4), suitable_basis(cell), GradientCorrection::on, element);
  finite_strain_forces(element, material, u, K, forces);
}
void second_order(int, const PointsRef& cell, const VectorXd& u, MatrixXd& K, VectorXd& forces) {
  TabulatedElement element;
  tabulate_quadratic(cell, dunavant_rule(4), suitable_basis(quadratic_corners(cell)), GradientCorrection::on,
                     element);
  finite_strain_forces(element, material, u, K, forces);
}

bool at_left(const Vec2& x) {
  return x.x() == 0;
}
bool at_right(const Vec2& x) {
  return x.x() == 2;
}
const PolygonMesh mesh = voronoi(support::rectangle(2, 1), {.n_cells = 40});
const PolygonMesh quadratic = with_edge_midpoints(mesh);

void expect_quadratic_convergence(const NewtonReport& report) {
  ASSERT_TRUE(report.converged) << report.reason;
  const std::vector<double>& r = report.residuals;
  for (std::size_t k = 2; k < r.size(); ++k)
    if (r[k - 1] < 1e-2) {
      EXPECT_LT(r[k], std::max(100 * r[k - 1] * r[k - 1], 1e-13)) << k;
    }
}

TEST(FiniteStrain, TangentIsTheDerivativeOfForces) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> moved(-0.005, 0.005);
  const Points cell = quadratic.outline(7);
  VectorXd d(2 * cell.cols()), ahead, behind, forces;
  for (double& value : d) value = moved(random);
  MatrixXd K, unused;
  second_order(0, cell, d, K, forces);
  const double step = 1e-6;
  for (Index k = 0; k < d.size(); ++k) {
    VectorXd shifted = d;
    shifted[k] += step;
    second_order(0, cell, shifted, unused, ahead);
    shifted[k] -= 2 * step;
    second_order(0, cell, shifted, unused, behind);
    EXPECT_LT(((ahead - behind) / (2 * step) - K.col(k)).norm(), 1e-7);
  }
}

TEST(FiniteStrain, UniformDeformationHasExactForces) {
  const Mat2 F = (Mat2() << 1.3, 0.2, -0.4, 0.9).finished();
  const Points cell = mesh.outline(7);
  MatrixXd K;
  VectorXd forces;
  first_order(0, cell, ((F - Mat2::Identity()) * cell).reshaped(), K, forces);
  for (Index i = 0; i < cell.cols(); ++i)
    EXPECT_LT((forces.segment<2>(2 * i) - material(0, F).P * boundary_integral(cell, i)).norm(), 1e-14);
}

TEST(NonlinearProblem, FindsAUniformDeformationFromItsBoundary) {
  const Mat2 G = (Mat2() << 0.5, 0.3, -0.2, -0.3).finished();
  NonlinearProblem problem(mesh, 2, first_order);
  for (const int v : boundary_vertices(mesh))
    for (const int axis : {0, 1}) problem.hold(v, axis, (G * mesh.vertices.col(v))[axis]);
  expect_quadratic_convergence(problem.solve(1));
  EXPECT_LT((problem.solution() - (G * mesh.vertices).reshaped()).lpNorm<Eigen::Infinity>(), 1e-11);
}

/// The stretch across of a bar stretched by `along` with free sides, P_yy = 0, by bisection, and P_xx.
Vec2 closed_form_tension(double along) {
  double low = 0.1, high = 1;
  const auto P = [&](double across) { return material(0, Vec2(along, across).asDiagonal()).P; };
  for (int k = 0; k < 60; ++k) (P((low + high) / 2)(1, 1) > 0 ? high : low) = (low + high) / 2;
  return {low, P(low)(0, 0)};
}

TEST(NonlinearProblem, PullsABarAsTheClosedFormSays) {
  const Vec2 closed_form = closed_form_tension(1.5);
  const double across = closed_form[0], stress = closed_form[1];
  NonlinearProblem problem(quadratic, 2, second_order);
  for (const int v : boundary_vertices(quadratic, at_left)) problem.hold(v, 0);
  for (const int v : boundary_vertices(quadratic, [](const Vec2& x) { return x.isZero(); }))
    problem.hold(v, 1);
  problem.add_edge_loads(quadratic_boundary_edges(quadratic, at_right),
                         [stress](const Vec2&, const Vec2&) { return Vec2(stress, 0); });
  for (const double t : {0.5, 1.}) expect_quadratic_convergence(problem.solve(t));
  const Mat2 G = Vec2(0.5, across - 1).asDiagonal();
  EXPECT_LT((problem.solution() - (G * quadratic.vertices).reshaped()).lpNorm<Eigen::Infinity>(), 1e-9);
}

TEST(NonlinearProblem, RollersOnAnInclinedEdgeTurnTheAnswerOfAStraightOne) {
  const auto pulled = [](double angle, Symmetry symmetry) {
    const Mat2 turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
    PolygonMesh turned = mesh;
    turned.vertices = turn * mesh.vertices;
    NonlinearProblem problem(turned, 2, first_order, symmetry);
    for (const int v : boundary_vertices(mesh, at_left)) {
      if (mesh.vertices.col(v).isZero())
        for (const int axis : {0, 1}) problem.hold(v, axis);
      else
        problem.roll(v, turn.col(0), 0.2);
    }
    problem.add_edge_loads(boundary_edges(mesh, at_right),
                           [&](const Vec2&, const Vec2&) { return VectorXd(turn * Vec2(0.3, 0.02)); });
    for (const double t : {0.5, 1.}) expect_quadratic_convergence(problem.solve(t));
    return VectorXd((turn.transpose() * problem.solution().reshaped(2, mesh.vertices.cols())).reshaped());
  };
  const VectorXd straight = pulled(0, Symmetry::symmetric);
  EXPECT_GT(straight.lpNorm<Eigen::Infinity>(), 0.2);
  EXPECT_LT((pulled(0.7, Symmetry::symmetric) - straight).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT((pulled(-2, Symmetry::none) - straight).lpNorm<Eigen::Infinity>(), 1e-9);
}

TEST(NonlinearProblem, KeepsTheLastConvergedSolutionAndSaysWhere) {
  NonlinearProblem problem(mesh, 2, first_order);
  for (const int v : boundary_vertices(mesh, at_left))
    for (const int axis : {0, 1}) problem.hold(v, axis);
  for (const int v : boundary_vertices(mesh, at_right))
    for (const int axis : {0, 1}) problem.hold(v, axis, axis == 0 ? -3 : 0);
  expect_quadratic_convergence(problem.solve(0.05));
  const VectorXd kept = problem.solution();
  const NewtonReport report = problem.solve(1);  // the bar would be turned round
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.reason.find("vertex "), std::string::npos) << report.reason;
  EXPECT_NE(report.reason.find("load"), std::string::npos) << report.reason;
  EXPECT_EQ(problem.solution(), kept);
  expect_quadratic_convergence(problem.solve(0.1));
}

/// A pressed bar whose tangents are too large by this factor: not solved, with the cell as the reason.
void expect_wrong_tangent(double factor) {
  NonlinearProblem problem(
      mesh, 2, [factor](int c, const PointsRef& cell, const VectorXd& u, MatrixXd& K, VectorXd& f) {
        first_order(c, cell, u, K, f);
        K *= factor;
      });
  for (const int v : boundary_vertices(mesh, at_left))
    for (const int axis : {0, 1}) problem.hold(v, axis);
  problem.add_edge_loads(boundary_edges(mesh, at_right), pressure(-0.3));
  const NewtonReport report = problem.solve(1);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.reason.find("the tangent of cell"), std::string::npos) << report.reason;
  EXPECT_TRUE(problem.solution().isZero());
}

TEST(NonlinearProblem, AWrongTangentIsReportedWithItsPlace) {
  expect_wrong_tangent(20);
}

#ifndef NDEBUG
/// Of a fifth too much Newton's method converges, slowly: the comparison with differences alone tells it.
TEST(NonlinearProblem, ASlightlyWrongTangentIsReportedWithAssertionsOn) {
  expect_wrong_tangent(1.2);
}
#endif

TEST(NonlinearProblem, MeasuresTheErrorOfATangent) {
  const auto forces = [](double factor) {
    return [factor](int c, const PointsRef& cell, const VectorXd& u, MatrixXd& K, VectorXd& f) {
      first_order(c, cell, u, K, f);
      K *= factor;
    };
  };
  const VectorXd u = (0.1 * mesh.vertices).reshaped();
  EXPECT_LT(NonlinearProblem(mesh, 2, forces(1)).tangent_error(3, u), 1e-7);
  EXPECT_GT(NonlinearProblem(mesh, 2, forces(1.02)).tangent_error(3, u), 1e-3);
  EXPECT_THROW(NonlinearProblem(mesh, 2, forces(1)).tangent_error(mesh.n_cells(), u), Error);
}

}  // namespace
