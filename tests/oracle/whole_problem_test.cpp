// The same problem on the same mesh by deal.II, from its own element to its own solver, and by us: plane
// strain under body forces that vary, held on three sides by displacements that vary, under tractions on the
// fourth.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <tests/oracle/deal_ii_solution.hpp>
#include <tests/support/random_polygon.hpp>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

Mat3 elasticity(const oracle::PlaneStrain& problem) {
  Mat3 D;
  D << problem.lambda + 2 * problem.mu, problem.lambda, 0,  //
      problem.lambda, problem.lambda + 2 * problem.mu, 0,   //
      0, 0, problem.mu;
  return D;
}

/// With a rule so fine that its error does not show, whatever the other side's is.
void integrate(const PointsRef& polygon, const oracle::PlaneStrain& problem, MatrixXd& K, VectorXd& f) {
  static const TriangleRule rule = collapsed_gauss_rule(14, 14);
  static TabulatedElement element;
  tabulate(polygon, rule, wachspress, GradientCorrection::on, element);
  stiffness(element, elasticity(problem), K);
  for (Index q = 0; q < element.n_points(); ++q)
    f.reshaped(2, element.n_vertices()) +=
        element.rule.weights[q] * problem.body_force(element.rule.points.col(q)) * element.values.row(q);
}

VectorXd our_solution(const TriangulationMesh& mesh, const oracle::PlaneStrain& problem) {
  FieldProblem field(mesh, 2);
  field.assemble(
      [&](int, const PointsRef& polygon, MatrixXd& K, VectorXd& f) { integrate(polygon, problem, K, f); });
  std::vector<std::array<int, 2>> loaded;
  for (const BoundaryLine& line : mesh.boundary) {
    if (line.boundary_id == oracle::loaded_boundary) {
      loaded.push_back(line.vertices);
      continue;
    }
    for (const int vertex : line.vertices)
      for (const int component : {0, 1})
        field.hold(vertex, component, problem.displacement(mesh.vertices.col(vertex))[component]);
  }
  field.add_edge_loads(
      loaded, [&](const Vec2& x, const Vec2& outward) -> VectorXd { return problem.stress(x) * outward; });
  return field.solve();
}

enum class Cells { parallelograms, trapezoids, triangles, quadrilaterals };

/// A unit square, coloured, its inner vertices moved at random so that cells are what is requested; turned.
void make(Cells cells, dealii::Triangulation<2>& triangulation) {
  constexpr unsigned n = 12;
  dealii::Triangulation<2> squares;
  dealii::GridGenerator::subdivided_hyper_rectangle(squares, {n, n}, dealii::Point<2>(),
                                                    dealii::Point<2>(1, 1), true);
  std::mt19937 random(1);
  const auto inside = [](double x) { return x > 1e-9 && x < 1 - 1e-9; };
  const auto shift = [&] { return support::uniform(-0.3, 0.3, random) / n; };
  dealii::GridTools::transform(
      [&](const dealii::Point<2>& p) {
        double x = p[0], y = p[1];
        if (cells == Cells::parallelograms) {
          x += 0.4 * y;
        } else if (inside(x) && inside(y)) {
          x += shift();
          if (cells != Cells::trapezoids) y += shift();
        }
        return dealii::Point<2>(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y);
      },
      squares);
  if (cells == Cells::triangles)  // eight in each
    dealii::GridGenerator::convert_hypercube_to_simplex_mesh(squares, triangulation);
  else
    triangulation.copy_triangulation(squares);
}

/// Largest difference of displacements over the largest displacement.
struct Comparison {
  double to_deal_ii, to_exact;
};

Comparison compare(Cells cells) {
  const oracle::PlaneStrain problem;
  dealii::Triangulation<2> triangulation;
  make(cells, triangulation);
  const TriangulationMesh mesh = polygon_mesh(triangulation);
  const VectorXd ours = our_solution(mesh, problem);
  const VectorXd theirs = oracle::deal_ii_solution(triangulation, mesh, problem);
  VectorXd exact(ours.size());
  for (Index i = 0; i < mesh.vertices.cols(); ++i)
    exact.segment<2>(2 * i) = problem.displacement(mesh.vertices.col(i));
  const double size = exact.lpNorm<Eigen::Infinity>();
  const Comparison result{(ours - theirs).lpNorm<Eigen::Infinity>() / size,
                          (ours - exact).lpNorm<Eigen::Infinity>() / size};
  return result;
}

class SameElement : public testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Cells, SameElement,
                         testing::Values(Cells::parallelograms, Cells::trapezoids, Cells::triangles));

TEST_P(SameElement, SameSolution) {
  const Comparison difference = compare(GetParam());
  EXPECT_LT(difference.to_deal_ii, 1e-10);
  EXPECT_LT(difference.to_exact, 1e-2);
  EXPECT_GT(difference.to_exact, 1e-5);  // what both have in common is more than the exact solution
}

TEST(AnotherElement, AnotherSolutionAsGood) {
  const Comparison difference = compare(Cells::quadrilaterals);
  EXPECT_GT(difference.to_deal_ii, 1e-6);
  EXPECT_LT(difference.to_deal_ii, difference.to_exact);
  EXPECT_LT(difference.to_exact, 1e-2);
}

}  // namespace
