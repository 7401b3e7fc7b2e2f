// A rubber beam bent by more than half of its length: large turns, Newton's method, quadratic cells.
//
//        |==========================+ | P, dead        length 4, height 1/2, plane strain,
//    held|                          | |                Neo-Hooke with nu = 0.3
//        |==========================+ v
//
// Equilibrium on the reference shape: for every test function v, integral of grad v : P(F) = work of the load
// on v, F = 1 + grad u. The tangent dP/dF is exact, so each of Newton's iterations squares the residual.
// The internal forces are derived from an energy W: the work that the load did on the way, the sum of
// P du by the trapezoidal rule over the load steps, must be the energy that is stored at the end.
#include <polyfem/assembly/nonlinear_problem.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/finite_strain.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/io/mesh_file.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <Eigen/LU>

#include <cmath>
#include <iostream>

using namespace polyfem;

constexpr double young = 1, poisson = 0.3;
constexpr double mu = young / (2 * (1 + poisson)), lambda = 2 * mu * poisson / (1 - 2 * poisson);
constexpr double P = 0.002;  // 2.8 E' I / L^2: the elastica sinks by 0.585 L, shear adds 0.01 L

void tabulate_cell(const PointsRef& cell, TabulatedElement& element) {
  tabulate_quadratic(cell, dunavant_rule(4), suitable_basis(quadratic_corners(cell)), GradientCorrection::on,
                     element);
}

double stored_energy(const PolygonMesh& mesh, const VectorXd& solution) {
  const Eigen::Map<const Points> displacements(solution.data(), 2, mesh.vertices.cols());
  TabulatedElement element;
  double energy = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    tabulate_cell(mesh.outline(c), element);
    const Points u = displacements(Eigen::all, std::vector<int>(mesh.cell(c).begin(), mesh.cell(c).end()));
    for (Index q = 0; q < element.n_points(); ++q) {
      Mat2 F = Mat2::Identity();
      F.col(0) += u * element.dx.row(q).transpose();
      F.col(1) += u * element.dy.row(q).transpose();
      const double log_J = std::log(F.determinant());
      energy +=
          element.rule.weights[q] * (mu / 2 * (F.squaredNorm() - 2 - 2 * log_J) + lambda / 2 * log_J * log_J);
    }
  }
  return energy;
}

int main() {
  Points beam(2, 4);
  beam << 0, 4, 4, 0,  //
      0, 0, 0.5, 0.5;
  const PolygonMesh mesh = with_edge_midpoints(voronoi(beam, {.n_cells = 128}));
  TabulatedElement element;
  NonlinearProblem problem(
      mesh, 2, [&](int, const PointsRef& cell, const VectorXd& u, MatrixXd& K, VectorXd& forces) {
        tabulate_cell(cell, element);
        finite_strain_forces(
            element, [](Index, const Mat2& F) { return neo_hooke(lambda, mu, F); }, u, K, forces);
      });
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.x() == 0; }))
    for (const int axis : {0, 1}) problem.hold(v, axis);
  const auto tip = quadratic_boundary_edges(mesh, [](const Vec2& x) { return x.x() == 4; });
  problem.add_edge_loads(tip, [](const Vec2&, const Vec2&) { return Vec2(0, -P / 0.5); });

  // The tip's mean displacement, weighted as the load: 1/6, 4/6, 1/6 of each edge.
  const auto sinking = [&] {
    double sum = 0;
    for (const auto& [first, middle, last] : tip) {
      const double length = (mesh.vertices.col(last) - mesh.vertices.col(first)).norm();
      const VectorXd& u = problem.solution();
      sum -= length / 6 * (u[2 * first + 1] + 4 * u[2 * middle + 1] + u[2 * last + 1]);
    }
    return sum / 0.5;
  };
  double work = 0, before = 0, t_before = 0;
  bool squares = true;
  constexpr int n_steps = 16;
  for (int step = 1; step <= n_steps; ++step) {
    const double t = 1. * step / n_steps;
    const NewtonReport report = problem.solve(t, 1e-11);
    if (!report.converged) {
      std::cerr << report.reason << '\n';
      return 1;
    }
    const double now = sinking();
    work += P * (t + t_before) / 2 * (now - before);
    before = now;
    t_before = t;
    if (step % 4 == 0) {
      std::cout << "load " << t << " P: the tip sinks by " << now << ", residuals";
      for (const double residual : report.residuals) std::cout << ' ' << residual;
      std::cout << '\n';
    }
    for (std::size_t k = 1; k < report.residuals.size(); ++k)
      if (report.residuals[k - 1] < 1e-3)
        squares =
            squares && report.residuals[k] < std::max(1e4 * std::pow(report.residuals[k - 1], 2), 1e-11);
  }
  const double energy = stored_energy(mesh, problem.solution());
  std::cout << "work " << work << ", stored energy " << energy << "\nshape: neo_hooke_beam.vtu\n";
  MeshFile file(mesh);
  file.add_vertex_field("displacement", problem.solution());
  file.write("neo_hooke_beam.vtu");
  return squares && std::abs(before / 4 - 0.595) < 0.005 && std::abs(work / energy - 1) < 2e-3 ? 0 : 1;
}
