// A plate cools down: the heat equation on Voronoi cells, by Crank-Nicolson steps.
//
//        du/dt - div grad u = 0 in the unit square,    u = 0 on its boundary,
//        u = sin(pi x) sin(pi y) at t = 0.
//
// With u = sum_j u_j(t) N_j it is M u' + K u = 0, M_ij = integral of N_i N_j, K_ij = integral of
// grad N_i . grad N_j, and its solution u = exp(-2 pi^2 t) sin(pi x) sin(pi y). Steps and cells of half the
// size must leave a quarter of the error.
#include <polyfem/assembly/theta_scheme.hpp>
#include <polyfem/element/default_element.hpp>
#include <polyfem/element/diffusion.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <cmath>
#include <iostream>
#include <numbers>

using namespace polyfem;
using std::numbers::pi;

/// The root mean square of the error at the vertices at t = 0.1, where the middle has cooled down to 0.139.
double error(int n_cells, int n_steps) {
  Points square(2, 4);
  square << 0, 1, 1, 0,  //
      0, 0, 1, 1;
  const PolygonMesh mesh = voronoi(square, {.n_cells = n_cells});
  TabulatedElement element;
  ThetaScheme scheme(
      mesh, 1,
      [&](int, const PointsRef& cell, MatrixXd& K, MatrixXd& M, VectorXd&) {
        tabulate(cell, element);
        diffusion(element, Mat2::Identity(), K);
        scalar_mass(element, M);
      },
      0.1 / n_steps, 0.5);
  const VectorXd start =
      (pi * mesh.vertices.row(0)).array().sin() * (pi * mesh.vertices.row(1)).array().sin();
  scheme.set_solution(start);
  for (const int v : boundary_vertices(mesh)) scheme.hold(v, 0);
  for (int k = 0; k < n_steps; ++k) scheme.step();
  const VectorXd error = scheme.solution() - std::exp(-2 * pi * pi * scheme.time()) * start;
  return std::sqrt(error.squaredNorm() / static_cast<double>(error.size()));
}

int main() {
  double coarse = 0, rate = 0;
  for (const int n : {16, 32, 64}) {
    const double fine = error(n * n, n / 2);
    rate = std::log2(coarse / fine);
    std::cout << n * n << " cells, " << n / 2 << " steps: error " << fine;
    if (coarse > 0) std::cout << ", rate " << rate;
    std::cout << '\n';
    coarse = fine;
  }
  return std::abs(rate - 2) < 0.1 && coarse < 2e-4 ? 0 : 1;
}
