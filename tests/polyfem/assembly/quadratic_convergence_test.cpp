// Quadratic cells: the patch test on meshes, and errors of a smooth field, of third order in L2 and of second
// order in energy.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/generators.hpp>
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

void tabulate_cell(const PointsRef& cell, int degree, GradientCorrection correction,
                   TabulatedElement& element) {
  tabulate_quadratic(cell, dunavant_rule(degree), suitable_basis(quadratic_corners(cell)), correction,
                     element);
}

bool on_left(const Vec2& x) {
  return x.x() == 0;
}

/// The left side held at the exact displacements, exact tractions on all others.
VectorXd solved(const PolygonMesh& quadratic, const support::ElasticSolution& exact) {
  const Mat3 D = elasticity_matrix(exact.young, exact.poisson, exact.plane);
  TabulatedElement element;
  FieldProblem problem(quadratic, 2);
  problem.assemble([&](int, const PointsRef& cell, MatrixXd& K, VectorXd& f) {
    tabulate_cell(cell, 4, GradientCorrection::on, element);
    stiffness(element, D, K);
    body_force(element, exact.body_force, f);
  });
  for (const int v : boundary_vertices(quadratic, on_left))
    for (const int axis : {0, 1}) problem.hold(v, axis, exact.displacement(quadratic.vertices.col(v))[axis]);
  problem.add_edge_loads(
      quadratic_boundary_edges(quadratic,
                               [](const Vec2& x) { return !on_left(x) || x.y() == 0 || x.y() == 1; }),
      [&](const Vec2& x, const Vec2& n) { return support::traction(exact.stress(x), n); });
  return problem.solve();
}

/// In L2 and in energy.
Vec2 errors_on(const PolygonMesh& mesh, const support::ElasticSolution& exact) {
  const PolygonMesh quadratic = with_edge_midpoints(mesh);
  const Points u = solved(quadratic, exact).reshaped(2, quadratic.vertices.cols());
  const Mat3 D = elasticity_matrix(exact.young, exact.poisson, exact.plane), compliance = D.inverse();
  TabulatedElement element;
  Tensors strain;
  Vec2 squares(0, 0);
  for (int c = 0; c < quadratic.n_cells(); ++c) {
    tabulate_cell(quadratic.outline(c), 8, GradientCorrection::off, element);
    const Points d = u(Eigen::all, std::vector<int>(quadratic.cell(c).begin(), quadratic.cell(c).end()));
    squares[0] += squared_displacement_error(element, d.reshaped(), exact.displacement);
    strains(element, d.reshaped(), strain);
    squares[1] += squared_energy_error(element, D, strain,
                                       [&](const Vec2& x) -> Vec3 { return compliance * exact.stress(x); });
  }
  return squares.cwiseSqrt();
}

/// Meshes of the unit square with n cells to a side.
struct Kind {
  const char* name;
  std::function<PolygonMesh(int n)> make;
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}

Vec2 bulged(const Vec2& x) {
  const double bulge = 0.1 * std::sin(std::numbers::pi * x.x()) * std::sin(std::numbers::pi * x.y());
  return x + Vec2(bulge, -bulge);
}
/// The trapezoids on which mapped 8-node quadrilaterals lose their rates (Arnold, Boffi and Falk 2002):
/// vertical sides of 3/4 and 5/4 of the cells' width in turn.
PolygonMesh trapezoids(int n) {
  PolygonMesh mesh = rectangles({0, 0}, {1, 1}, n, n);
  for (auto x : mesh.vertices.colwise()) {
    const auto column = std::lround(x[0] * n), row = std::lround(x[1] * n);
    if (row % 2 == 1) x[1] += (column % 2 == 0 ? 0.25 : -0.25) / n;
  }
  return mesh;
}
const Kind kinds[] = {
    {"trapezoids", trapezoids},
    {"quadrilaterals",
     [](int n) {
       return mapped(rectangles({0, 0}, {1, 1}, n, n), bulged);
     }},
    {"hexagons",
     [](int n) {
       return mapped(hexagons({0, 0}, {1, 1}, n, n), bulged);
     }},
    {"voronoi", [](int n) { return voronoi(support::rectangle(1, 1), {.n_cells = n * n}); }},
    {"chevrons",
     [](int n) {
       return chevrons({0, 0}, {1, 1}, n, n);
     }},
    {"bricks", [](int n) {
       return bricks({0, 0}, {1, 1}, n, n);
     }}};

class QuadraticConvergence : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, QuadraticConvergence, testing::ValuesIn(kinds),
                         [](const auto& kind) { return kind.param.name; });

TEST_P(QuadraticConvergence, HasRatesThreeAndTwo) {
  const support::ElasticSolution exact = support::manufactured_solution(1, 0.3);
  const Vec2 coarse = errors_on(GetParam().make(8), exact), fine = errors_on(GetParam().make(24), exact);
  const Vec2 rates = (coarse.array() / fine.array()).log() / std::log(3);
  EXPECT_NEAR(rates[0], 3, 0.1);
  EXPECT_NEAR(rates[1], 2, 0.1);
}

TEST_P(QuadraticConvergence, PassesTheQuadraticPatchTest) {
  support::ElasticSolution exact;
  const Mat3 D = elasticity_matrix(exact.young, exact.poisson, exact.plane);
  exact.displacement = [](const Vec2& x) {
    return Vec2(x.x() * x.x() - 0.4 * x.x() * x.y() + x.y(), 0.3 * x.y() * x.y() + 0.8 * x.x() * x.y());
  };
  exact.stress = [D](const Vec2& x) -> Vec3 {
    return D * Vec3(2 * x.x() - 0.4 * x.y(), 0.6 * x.y() + 0.8 * x.x(), 1 - 0.4 * x.x() + 0.8 * x.y());
  };
  exact.body_force = [D](const Vec2&) -> Vec2 {
    const Vec3 by_x = D * Vec3(2, 0.8, -0.4), by_y = D * Vec3(-0.4, 0.6, 0.8);
    return -Vec2(by_x[0] + by_y[2], by_x[2] + by_y[1]);
  };
  const PolygonMesh quadratic = with_edge_midpoints(GetParam().make(6));
  const VectorXd u = solved(quadratic, exact);
  for (int v = 0; v < quadratic.vertices.cols(); ++v)
    EXPECT_LT((u.segment<2>(2 * v) - exact.displacement(quadratic.vertices.col(v))).norm(), 1e-11)
        << quadratic.vertex_name(v);
}

TEST(QuadraticEdgeLoads, AreRefusedOffTheMiddleAndOnEdgesThatAreNotThere) {
  PolygonMesh quadratic = with_edge_midpoints(rectangles({0, 0}, {1, 1}, 1, 1));
  const auto load = [](const Vec2&, const Vec2&) { return VectorXd::Ones(1); };
  auto edges = quadratic_boundary_edges(quadratic, on_left);
  ASSERT_EQ(edges.size(), 1u);
  std::swap(edges[0][0], edges[0][2]);
  FieldProblem problem(quadratic, 1);
  EXPECT_THROW(problem.add_edge_loads(edges, load), Error) << "turned round";
  std::swap(edges[0][0], edges[0][2]);
  problem.add_edge_loads(edges, load);
  quadratic.vertices(1, edges[0][1]) += 0.1;
  FieldProblem uneven(quadratic, 1);
  EXPECT_THROW(uneven.add_edge_loads(edges, load), Error) << "off the middle";
}

}  // namespace
