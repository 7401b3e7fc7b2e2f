#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/virtual_element.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>
#include <tests/support/elastic_solutions.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>

using namespace polyfem;

namespace {

const Mat3 D = elasticity_matrix(2, 0.3, Plane::strain);

TEST(VirtualElement, OnTrianglesIsTheLinearTriangle) {
  std::mt19937 random(3);
  const Points triangle = support::random_convex_polygon(3, random);
  TabulatedElement element;
  tabulate(triangle, dunavant_rule(1), wachspress, GradientCorrection::on, element);
  MatrixXd K, expected;
  stiffness(element, D, expected);
  virtual_stiffness(triangle, D, K);
  EXPECT_LT((K - expected).norm(), 1e-13 * expected.norm());
  VectorXd f = VectorXd::Zero(6), expected_f = f;
  body_force(element, Vec2(1, -2), expected_f);
  tabulate_virtual(triangle, element);
  body_force(element, Vec2(1, -2), f);
  EXPECT_LT((f - expected_f).norm(), 1e-14);
}

TEST(VirtualElement, LinearFieldsAreExactAndOnlyRigidMotionsCostNothing) {
  std::mt19937 random(5);
  const Mat2 G = (Mat2() << 0.5, 0.3, -0.2, 0.4).finished();
  const Vec3 strain(G(0, 0), G(1, 1), G(0, 1) + G(1, 0));
  for (const int n : {4, 5, 8, 12}) {
    const Points polygon = n == 12 ? support::star(6) : support::random_convex_polygon(n, random);
    const VectorXd d = (G * polygon).reshaped();
    MatrixXd K;
    virtual_stiffness(polygon, D, K);
    EXPECT_NEAR(d.dot(K * d), signed_area(polygon) * strain.dot(D * strain), 1e-12 * signed_area(polygon));
    TabulatedElement element;
    tabulate_virtual(polygon, dunavant_rule(2), element);
    Tensors strains_there;
    strains(element, d, strains_there);
    EXPECT_LT((strains_there.colwise() - strain).norm(), 1e-12);
    EXPECT_LT((d.reshaped(2, n) * element.values.transpose() - G * element.rule.points).norm(), 1e-12);
    const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(K).eigenvalues();
    EXPECT_LT(std::abs(values[2]), 1e-13 * values[2 * n - 1]);
    EXPECT_GT(values[3], 1e-3 * values[2 * n - 1]);
    VectorXd f = VectorXd::Zero(2 * n);
    tabulate_virtual(polygon, element);
    body_force(element, Vec2(3, 4), f);
    const AreaMoments moments = area_moments(polygon);
    EXPECT_NEAR(f.dot(d), moments.area * (G * moments.centroid).dot(Vec2(3, 4)), 1e-12 * moments.area);
  }
}

TEST(VirtualElement, PassesThePatchTest) {
  const PolygonMesh mesh = voronoi(support::l_shape(), {.n_cells = 60});
  const Mat2 G = (Mat2() << 0.5, 0.3, -0.2, 0.4).finished();
  FieldProblem problem(mesh, 2);
  problem.assemble(
      [](int, const PointsRef& polygon, MatrixXd& K, VectorXd&) { virtual_stiffness(polygon, D, K); });
  for (const int v : boundary_vertices(mesh))
    for (const int axis : {0, 1}) problem.hold(v, axis, (G * mesh.vertices.col(v))[axis]);
  EXPECT_LT((problem.solve() - (G * mesh.vertices).reshaped()).lpNorm<Eigen::Infinity>(), 1e-12);
}

/// Errors of a manufactured solution in the energy and in L2.
Vec2 errors(const PolygonMesh& mesh) {
  const support::ElasticSolution solution = support::manufactured_solution(2, 0.3);
  FieldProblem problem(mesh, 2);
  TabulatedElement element;
  problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    virtual_stiffness(polygon, D, K);
    tabulate_virtual(polygon, element);
    body_force(element, solution.body_force, f);
  });
  for (const int v : boundary_vertices(mesh))
    for (const int axis : {0, 1}) problem.hold(v, axis, solution.displacement(mesh.vertices.col(v))[axis]);
  problem.solve();
  double energy = 0, l2 = 0;
  Tensors strain;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    tabulate_virtual(mesh.outline(c), dunavant_rule(4), element);
    const VectorXd d = problem.cell_solution(c);
    strains(element, d, strain);
    l2 += squared_displacement_error(element, d, solution.displacement);
    energy += squared_energy_error(element, D, strain,
                                   [&](const Vec2& x) { return Vec3(D.inverse() * solution.stress(x)); });
  }
  return {std::sqrt(energy), std::sqrt(l2)};
}

TEST(VirtualElement, ConvergesWithRatesOneAndTwo) {
  const Points square = support::rectangle(1, 1);
  for (const bool concave : {false, true}) {
    const auto mesh_of = [&](int n) {
      return concave ? chevrons({0, 0}, {1, 1}, n, n) : voronoi(square, {.n_cells = n * n});
    };
    const Vec2 coarse = errors(mesh_of(16)), fine = errors(mesh_of(64));
    EXPECT_NEAR(std::log(coarse[0] / fine[0]) / std::log(4.), 1, 0.1);
    EXPECT_NEAR(std::log(coarse[1] / fine[1]) / std::log(4.), 2, 0.15);
  }
}

}  // namespace
