// A bar that is pulled until it cracks: damage with history, a fracture energy that no mesh changes.
//
//      |=======|===|=======|            length 1, height 0.2, plane stress; the column of cells in the middle
//      |=======|===|=======| -> d       cracks at half the strength of the others
//
// Beyond its strength the material softens: strains gather in the weak column while the rest unloads. All of
// the bar carries one stress, that of the crack with the strain that is left for it,
//     s = E e for strains e below the onset,  E onset exp(-(e - onset) / softening) beyond.
// The softening is chosen so that a crack of one column costs the same energy on any mesh (crack band, Bazant
// and Oh 1983); plain softening would cost less the finer the mesh is. Tangents are not positive definite
// there, hence Symmetry::none. Each of Newton's iterations squares the residual, with what points remember
// fixed until the step converges.
#include <polyfem/assembly/history.hpp>
#include <polyfem/assembly/nonlinear_problem.hpp>
#include <polyfem/element/default_element.hpp>
#include <polyfem/element/small_strain.hpp>
#include <polyfem/material/isotropic_damage.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace polyfem;

constexpr double young = 1000, onset = 1e-3, height = 0.2, fracture_energy = 2e-3;

/// Pulls a bar of n columns to d = 0.012. Whether it follows the closed form and Newton squares.
bool pull(int n) {
  const PolygonMesh mesh = rectangles({0, 0}, {1, height}, n, 2);
  const double width = 1. / n, softening = fracture_energy / (young * onset * width) - onset / 2;
  const Mat3 D = elasticity_matrix(young, 0, Plane::stress);
  History<double> history(mesh.n_cells());  // the largest strain of each point so far
  double stress = 0;
  NonlinearProblem problem(
      mesh, 2,
      [&](int cell, const PointsRef& polygon, const VectorXd& u, MatrixXd& K, VectorXd& forces) {
        TabulatedElement element;
        tabulate(polygon, element);
        const bool weak = std::abs(polygon.row(0).mean() - 0.5) < width / 2;
        const DamageMaterial material{D, young, weak ? onset : 2 * onset, softening};
        const auto states = history.cell(cell, element.n_points());
        small_strain_forces(
            element,
            [&](Index q, const Vec3& strain, Mat3& tangent) {
              const auto at = static_cast<std::size_t>(q);
              const DamageStep step = damage_step(material, strain, states.before[at]);
              states.now[at] = step.largest_strain;
              tangent = step.tangent;
              stress = step.stress[0];
              return step.stress;
            },
            u, K, forces);
      },
      Symmetry::none);
  constexpr double elongation = 0.012;
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.x() == 0 || x.x() == 1; }))
    problem.hold(v, 0, mesh.vertices(0, v) * elongation);
  problem.hold(0, 1);

  constexpr int n_steps = 120;
  double work = 0, stress_before = 0;
  bool squares = true, follows = true;
  for (int k = 1; k <= n_steps; ++k) {
    const NewtonReport report = problem.solve(1. * k / n_steps, 1e-9);
    if (!report.converged) {
      std::printf("%s\n", report.reason.c_str());
      return false;
    }
    history.commit();
    work += (stress_before + stress) / 2 * height * elongation / n_steps;
    stress_before = stress;
    const double crack = elongation * k / n_steps - stress / young * (1 - width), strain = crack / width;
    const double closed =
        strain < onset ? young * strain : young * onset * std::exp(-(strain - onset) / softening);
    follows = follows && std::abs(stress / closed - 1) < 1e-8;
    const std::vector<double>& r = report.residuals;
    for (std::size_t i = 2; i < r.size(); ++i)
      if (r[i - 1] < 1e-2) squares = squares && r[i] < std::max(1e3 * r[i - 1] * r[i - 1], 1e-9);
    if (k % 20 == 0) {
      std::printf("%2d columns, d = %.4f: stress %.5f, residuals", n, elongation * k / n_steps, stress);
      for (const double residual : r) std::printf(" %.1e", residual);
      std::printf("\n");
    }
  }
  const double per_area = work / height;
  std::printf("%2d columns: the crack cost %.4e for %.4e\n", n, per_area, fracture_energy);
  return follows && squares && std::abs(per_area / fracture_energy - 1) < 0.02;
}

int main() {
  const bool coarse = pull(5), fine = pull(15);
  return coarse && fine ? 0 : 1;
}
