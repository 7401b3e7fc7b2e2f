// A standing pressure wave between two walls: elastodynamics on quadratic cells, by Newmark's scheme.
//
//        rho u'' - div sigma = 0 in 0 < x < 1, 0 < y < 1/4;    u_x = 0 on both ends, u_y = 0 everywhere.
//
//        u_x = sin(pi x) cos(omega t),    omega = pi c,    c = sqrt((lambda + 2 mu) / rho)
//
// Average acceleration (beta = 1/4, gamma = 1/2) keeps the energy to round-off and lengthens the period by
// (omega dt)^2 / 12: the program compares the displacement after two periods with that.
#include <polyfem/assembly/newmark_scheme.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <cmath>
#include <iostream>
#include <numbers>

using namespace polyfem;
using std::numbers::pi;

int main() {
  const double density = 2;
  const Mat3 D = elasticity_matrix(10, 0.3, Plane::strain);
  const double omega = pi * std::sqrt(D(0, 0) / density), period = 2 * pi / omega;
  constexpr int steps_a_period = 40;

  Points strip(2, 4);
  strip << 0, 1, 1, 0,  //
      0, 0, 0.25, 0.25;
  const PolygonMesh mesh = with_edge_midpoints(voronoi(strip, {.n_cells = 100}));
  const int n_vertices = static_cast<int>(mesh.vertices.cols());
  TabulatedElement element;
  NewmarkScheme scheme(
      mesh, 2,
      [&](int, const PointsRef& cell, MatrixXd& K, MatrixXd& M, VectorXd&) {
        tabulate_quadratic(cell, dunavant_rule(6), suitable_basis(quadratic_corners(cell)),
                           GradientCorrection::on, element);
        stiffness(element, D, K);
        mass(element, M);
        M *= density;
      },
      period / steps_a_period);

  VectorXd u = VectorXd::Zero(2 * n_vertices);
  for (int v = 0; v < n_vertices; ++v) {
    const double x = mesh.vertices(0, v);
    u[2 * v] = std::sin(pi * x);
    scheme.hold(v, 1);
    if (x == 0 || x == 1) scheme.hold(v, 0);
  }
  const VectorXd none = VectorXd::Zero(u.size());
  scheme.start(u, none, none);
  const double energy = scheme.energy();
  for (int k = 0; k < 2 * steps_a_period; ++k) scheme.step();

  // cos of the discrete frequency: tan(omega_h dt / 2) = omega dt / 2.
  const double dt = period / steps_a_period;
  const double omega_h = 2 / dt * std::atan(omega * dt / 2);
  const double off =
      (scheme.displacements() - std::cos(omega_h * scheme.time()) * u).lpNorm<Eigen::Infinity>();
  const double energy_off = std::abs(scheme.energy() / energy - 1);
  std::cout << "after two periods: amplitude off by " << off << " of the discrete solution, energy by "
            << energy_off << "\nthe period is " << omega / omega_h << " of the exact one\n";
  return off < 2e-3 && energy_off < 1e-10 ? 0 : 1;
}
