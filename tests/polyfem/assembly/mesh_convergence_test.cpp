// Errors of smooth fields: of second order in L2, of first order in energy.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/vertex_moves.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>
#include <tests/support/elastic_solutions.hpp>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>

using namespace polyfem;

namespace {

struct Errors {
  double l2 = 0, energy = 0;  ///< absolute
};

/// All of the boundary held at the exact displacements.
Errors errors_on(const PolygonMesh& mesh, const support::ElasticSolution& exact) {
  const Mat3 D = elasticity_matrix(exact.young, exact.poisson, exact.plane);
  TabulatedElement element;
  FieldProblem problem(mesh, 2);
  problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    tabulate(polygon, hammer_rule(3), wachspress, GradientCorrection::on, element);
    stiffness(element, D, K);
    for (Index q = 0; q < element.n_points(); ++q) {
      const Vec2 force = element.rule.weights[q] * exact.body_force(element.rule.points.col(q));
      f.reshaped(2, element.n_vertices()) += force * element.values.row(q);
    }
  });
  for (const int v : boundary_vertices(mesh)) {
    const Vec2 u = exact.displacement(mesh.vertices.col(v));
    for (const int component : {0, 1}) problem.hold(v, component, u[component]);
  }
  const Points u = problem.solve().reshaped(2, mesh.vertices.cols());

  Errors squares;
  Tensors strain;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    tabulate(mesh.outline(c), hammer_rule(5), wachspress, GradientCorrection::on, element);
    const Points d = u(Eigen::all, std::vector<int>(mesh.cell(c).begin(), mesh.cell(c).end()));
    strains(element, d.reshaped(), strain);
    for (Index q = 0; q < element.n_points(); ++q) {
      const Vec2 x = element.rule.points.col(q);
      const Vec3 stress_error = D * strain.col(q) - exact.stress(x);
      squares.l2 += element.rule.weights[q] *
                    (d * element.values.row(q).transpose() - exact.displacement(x)).squaredNorm();
      squares.energy += element.rule.weights[q] * stress_error.dot(D.inverse() * stress_error);
    }
  }
  return {std::sqrt(squares.l2), std::sqrt(squares.energy)};
}

/// Meshes of the unit square with n cells to a side.
struct Kind {
  const char* name;
  std::function<PolygonMesh(int n)> make;
  int coarse, fine;
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

Vec2 bulged(const Vec2& x) {
  const double bulge = 0.1 * std::sin(std::numbers::pi * x.x()) * std::sin(std::numbers::pi * x.y());
  return x + Vec2(bulge, -bulge);
}
const Kind kinds[] = {
    {"quadrilaterals",
     [](int n) {
       return mapped(rectangles({0, 0}, {1, 1}, n, n), bulged);
     },
     16, 48},
    {"hexagons",
     [](int n) {
       return mapped(hexagons({0, 0}, {1, 1}, n, n), bulged);
     },
     16, 48},
    {"voronoi", [](int n) { return voronoi(support::rectangle(1, 1), {.n_cells = n * n}); }, 16, 64}};

class MeshConvergence : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, MeshConvergence, testing::ValuesIn(kinds),
                         [](const auto& kind) { return kind.param.name; });

TEST_P(MeshConvergence, HasRatesTwoAndOne) {
  const support::ElasticSolution exact = support::manufactured_solution(1, 0.3);
  const auto [name, make, n_coarse, n_fine] = GetParam();
  const Errors coarse = errors_on(make(n_coarse), exact), fine = errors_on(make(n_fine), exact);
  const double refinement = std::log(1. * n_fine / n_coarse);
  EXPECT_NEAR(std::log(coarse.l2 / fine.l2) / refinement, 2, 0.05);
  EXPECT_NEAR(std::log(coarse.energy / fine.energy) / refinement, 1, 0.05);
}

}  // namespace
