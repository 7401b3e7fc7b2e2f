// Poisson's equation on a mesh of Voronoi cells.
//
//        -div grad u = g   in the unit square,        u = 0   on its boundary.
//
// Multiplied by a test function v that is 0 on the boundary, and integrated by parts,
//
//        integral of grad v . grad u  =  integral of v g.
//
// With u = sum_j u_j N_j and each N_i as v, cell by cell, this is K u = f with
//
//        K_ij = integral of grad N_i . grad N_j,     f_i = integral of N_i g.
//
// g = 2 pi^2 sin(pi x) sin(pi y) makes u = sin(pi x) sin(pi y) the solution. Shape functions on polygons
// contain all linear ones, so cells of half the size must leave a quarter of the error in the mean (L2):
// rate 2.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/diffusion.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <cmath>
#include <iostream>
#include <numbers>

using namespace polyfem;
using std::numbers::pi;

double exact(const Vec2& x) {
  return std::sin(pi * x.x()) * std::sin(pi * x.y());
}
double source(const Vec2& x) {
  return 2 * pi * pi * exact(x);
}

VectorXd solve(const PolygonMesh& mesh) {
  FieldProblem problem(mesh, 1);  // one unknown a vertex
  TabulatedElement element;
  problem.assemble([&](int, const PointsRef& cell, MatrixXd& K, VectorXd& f) {
    tabulate_to_tolerance(cell, suitable_basis(cell), 1e-3, GradientCorrection::on, element);
    diffusion(element, Mat2::Identity(), K);
    for (Index q = 0; q < element.n_points(); ++q)
      f += element.rule.weights[q] * source(element.rule.points.col(q)) * element.values.row(q);
  });
  for (const int vertex : boundary_vertices(mesh)) problem.hold(vertex, 0);
  return problem.solve();
}

/// The root of the integral of (u_h - u)^2.
double error(const PolygonMesh& mesh, const VectorXd& u) {
  double square = 0;
  TabulatedElement element;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points cell = mesh.outline(c);
    tabulate_to_tolerance(cell, suitable_basis(cell), 1e-3, GradientCorrection::on, element);
    const VectorXd of_cell = u(std::vector<int>(mesh.cell(c).begin(), mesh.cell(c).end()));
    square += squared_error(element, of_cell, exact);
  }
  return std::sqrt(square);
}

int main() {
  Points square(2, 4);
  square << 0, 1, 1, 0,  //
      0, 0, 1, 1;
  double coarse = 0, rate = 0;
  for (const int n_cells : {256, 1024, 4096}) {
    const PolygonMesh mesh = voronoi(square, {.n_cells = n_cells});
    const double fine = error(mesh, solve(mesh));
    rate = std::log2(coarse / fine);
    std::cout << n_cells << " cells: error " << fine;
    if (coarse > 0) std::cout << ", rate " << rate;
    std::cout << '\n';
    coarse = fine;
  }
  return std::abs(rate - 2) < 0.05 && coarse < 3e-4 ? 0 : 1;
}
