// The limit pressure of a thick ring of von Mises' material: plasticity with history, quadratic cells.
//
//        a quarter of a ring a < r < b, plane strain, pressure p inside; symmetry on both straight sides
//
// As long as a part of it is elastic the ring stands; at p = 2 / sqrt(3) (yield stress) ln(b / a) all of it
// flows (Hill 1950, chapter V). The program raises p in steps. Each cell remembers plastic strains at its
// integration points; Newton's iterations start from those at the end of the last step that converged, and
// what they find becomes history when the step converges. p must be carried up to 0.98 of the limit
// and not at 1.02. The tangent is that of the backward Euler step, so each iteration squares the residual
// once the plastic zone is found.
#include <polyfem/assembly/history.hpp>
#include <polyfem/assembly/nonlinear_problem.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/element/small_strain.hpp>
#include <polyfem/material/j2_plasticity.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/vertex_moves.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

using namespace polyfem;

constexpr double a = 1, b = 2;

int main() {
  const J2Material material{.bulk = 1000, .shear = 400, .yield_stress = 1};
  const double limit = 2 / std::sqrt(3.) * material.yield_stress * std::log(b / a);

  PolygonMesh ring = mapped(rectangles({a, 0}, {b, 1}, 8, 16), [](const Vec2& x) {
    const double angle = std::numbers::pi / 2 * x.y();
    return Vec2(x.x() * std::cos(angle), x.x() * std::sin(angle));
  });
  for (Index v = 0; v < ring.vertices.cols(); ++v)
    if (std::abs(ring.vertices(0, v)) < 1e-12) ring.vertices(0, v) = 0;
  const PolygonMesh mesh = with_edge_midpoints(ring);

  History<PlasticState> history(mesh.n_cells());
  TabulatedElement element;
  NonlinearProblem problem(
      mesh, 2, [&](int cell, const PointsRef& polygon, const VectorXd& u, MatrixXd& K, VectorXd& forces) {
        tabulate_quadratic(polygon, dunavant_rule(4), suitable_basis(quadratic_corners(polygon)),
                           GradientCorrection::on, element);
        const auto states = history.cell(cell, element.n_points());
        small_strain_forces(
            element,
            [&](Index q, const Vec3& strain, Mat3& tangent) {
              const auto at = static_cast<std::size_t>(q);
              const PlasticStep step = j2_step(material, strain, states.before[at]);
              states.now[at] = step.state;
              tangent = step.tangent;
              return step.stress;
            },
            u, K, forces);
      });
  for (const int axis : {0, 1})
    for (const int v : boundary_vertices(mesh, [axis](const Vec2& x) { return x[axis] == 0; }))
      problem.hold(v, axis);
  const double chord =
      a * std::cos(std::numbers::pi / 64);  // the inner edges' least distance from the centre
  problem.add_edge_loads(
      quadratic_boundary_edges(mesh,
                               [&](const Vec2& x) { return x.norm() < a + 1e-9 && x.norm() > chord - 1e-9; }),
      pressure(limit));

  double carried = 0;
  bool squares = true;
  for (const double p : {0.4, 0.6, 0.7, 0.8, 0.86, 0.9, 0.93, 0.96, 0.98, 1.02}) {  // over the limit
    const NewtonReport report = problem.solve(p, 1e-9);
    if (!report.converged) {
      std::cout << "p = " << p << " of the limit: " << report.reason << '\n';
      break;
    }
    carried = p;
    const std::vector<double>& residuals = report.residuals;
    for (std::size_t k = 2; k < residuals.size(); ++k)
      if (residuals[k - 1] < 1e-3)
        squares = squares && residuals[k] < std::max(1e3 * residuals[k - 1] * residuals[k - 1], 1e-11);
    history.commit();
    int n_points = 0, n_plastic = 0;
    for (const auto& states : history.states())
      for (const PlasticState& state : states) {
        ++n_points;
        n_plastic += state.equivalent > 0;
      }
    std::cout << "p = " << p << " of the limit: " << 100 * n_plastic / n_points
              << " % plastic, the inner side moves by "
              << problem.solution().reshaped(2, mesh.vertices.cols()).colwise().norm().maxCoeff()
              << ", residuals";
    for (const double residual : residuals) std::cout << ' ' << residual;
    std::cout << '\n';
  }
  return carried == 0.98 && squares ? 0 : 1;
}
