// Elasticity on Voronoi cells of first and of second order.
//
//        - div sigma = b in the unit square,    u = 0 on its boundary,
//        sigma = lambda tr(eps) 1 + 2 mu eps.
//
// A quadratic cell has an unknown also in the middle of each edge, and shape functions that contain all
// quadratic polynomials: cells of half the size leave an eighth of the error in the mean (L2), not a quarter.
// Two lines differ from the element of first order: the mesh gets midpoints, and shape functions are
// tabulated by `tabulate_quadratic`.
//
//        u = (sin(pi x) sin(pi y), 0)
//
// is the solution for b = -(lambda + mu) grad div u - mu laplace u, the force below.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/core/stopwatch.hpp>
#include <polyfem/element/default_element.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <cmath>
#include <iostream>
#include <numbers>
#include <utility>

using namespace polyfem;
using std::numbers::pi;

const double young = 1, poisson = 0.3;
const Mat3 D = elasticity_matrix(young, poisson, Plane::strain);
const double lambda = D(0, 1), mu = D(2, 2);

Vec2 exact(const Vec2& x) {
  return {std::sin(pi * x.x()) * std::sin(pi * x.y()), 0};
}
Vec2 force(const Vec2& x) {
  const double cosines = std::cos(pi * x.x()) * std::cos(pi * x.y());
  return pi * pi * ((lambda + mu) * Vec2(exact(x).x(), -cosines) + 2 * mu * exact(x));
}

/// First order: vertices are corners. Second order: corners and midpoints in turn.
using Tabulate = void (*)(const PointsRef& cell, TabulatedElement& element);

void first_order(const PointsRef& cell, TabulatedElement& element) {
  tabulate(cell, element);
}
void second_order(const PointsRef& cell, TabulatedElement& element) {
  tabulate_quadratic(cell, element);
}

VectorXd solve(const PolygonMesh& mesh, Tabulate tabulate) {
  FieldProblem problem(mesh, 2);
  TabulatedElement element;
  problem.assemble([&](int, const PointsRef& cell, MatrixXd& K, VectorXd& f) {
    tabulate(cell, element);
    stiffness(element, D, K);
    body_force(element, force, f);
  });
  for (const int vertex : boundary_vertices(mesh))
    for (const int axis : {0, 1}) problem.hold(vertex, axis);
  return problem.solve();
}

/// The root of the integral of |u_h - u|^2.
double error(const PolygonMesh& mesh, Tabulate tabulate, const VectorXd& u) {
  const Eigen::Map<const Points> displacements(u.data(), 2, mesh.vertices.cols());
  double square = 0;
  TabulatedElement element;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    tabulate(mesh.outline(c), element);
    const Points d = displacements(Eigen::all, std::vector<int>(mesh.cell(c).begin(), mesh.cell(c).end()));
    square += squared_displacement_error(element, d.reshaped(), exact);
  }
  return std::sqrt(square);
}

/// The error of the finest mesh, and the rate to it.
std::pair<double, double> refine(const char* name, Tabulate tabulate, bool quadratic) {
  Points square(2, 4);
  square << 0, 1, 1, 0,  //
      0, 0, 1, 1;
  double fine = 0, rate = 0;
  for (const int n_cells : {64, 256, 1024, 4096}) {
    PolygonMesh mesh = voronoi(square, {.n_cells = n_cells});
    if (quadratic) mesh = with_edge_midpoints(mesh);
    double seconds = 0;
    VectorXd u;
    {
      const Stopwatch watch(seconds);
      u = solve(mesh, tabulate);
    }
    const double coarse = std::exchange(fine, error(mesh, tabulate, u));
    rate = std::log2(coarse / fine);
    std::cout << name << ", " << n_cells << " cells, " << u.size() << " unknowns: error " << fine;
    if (coarse > 0) std::cout << ", rate " << rate;
    std::cout << ", " << seconds << " s\n";
  }
  return {fine, rate};
}

int main() {
  const auto [error_1, rate_1] = refine("first order", first_order, false);
  const auto [error_2, rate_2] = refine("second order", second_order, true);
  return std::abs(rate_1 - 2) < 0.1 && std::abs(rate_2 - 3) < 0.1 && error_2 < error_1 / 50 ? 0 : 1;
}
