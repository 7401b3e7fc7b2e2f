// deal.II makes and refines the mesh, polyfem solves on it, deal.II judges and draws.
//
//    +-----+        Laplace's equation, div grad u = 0, around a corner that points inward, with
//    |     |            u = r^(2/3) sin(2 theta / 3)
//    |     |        prescribed on the boundary. theta runs from the side above the corner o, where u = 0,
//    |     o----+   to the one right of it, where u = 0 again. This is the solution inside too; its gradient
//    |          |   is infinite at o, so that halving all n cells twice, 16 n of them, makes the energy
//    |          |   error smaller by 2.5 only. Refined where deal.II finds the error, it falls like
//    +----------+   1/sqrt(n), as if u were smooth.
//
// Cells of such a mesh meet cells half their size:
//
//    +-------+---+    The node x in the middle of the larger cell's side is called hanging. Bilinear
//    |       |   |    functions are linear along that side: in deal.II x has no say and is tied to its
//    |       x---+    neighbours. Here the larger cell is a pentagon with a straight corner at x and a shape
//    |       |   |    function for it: nothing is tied, and x carries an unknown like any other vertex.
//    +-------+---+    Mean value functions do not mind straight corners; squares keep Wachspress
//                     functions, which are the bilinear ones there. Both are linear along a side, so
//                     that they fit together.
//
// Each cycle: triangulation -> polygons -> u at the vertices -> a vector of deal.II, whose error estimator
// (Kelly's, the jumps of the normal derivative) says which fifth of the cells to refine.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/dealii/vertex_dofs.hpp>
#include <polyfem/element/tabulated_element.hpp>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_refinement.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/error_estimator.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <numbers>

using namespace polyfem;

namespace {

double theta(const Vec2& x) {  // 0 above the corner, 3 pi / 2 right of it
  const double angle = std::atan2(-x.x(), x.y());
  return angle < -1e-12 ? angle + 2 * std::numbers::pi : angle;
}

double exact(const Vec2& x) {
  return std::pow(x.norm(), 2.0 / 3) * std::sin(2 * theta(x) / 3);
}

Vec2 exact_gradient(const Vec2& x) {
  const double size = 2.0 / 3 * std::pow(x.norm(), -1.0 / 3), angle = theta(x) / 3;
  return size * Vec2(-std::cos(angle), -std::sin(angle));
}

void tabulate_cell(const PointsRef& polygon, TabulatedElement& element) {
  tabulate(polygon, dunavant_rule(5), suitable_basis(polygon), GradientCorrection::on, element);
}

/// Values at the vertices: the exact ones on the boundary, inside K u = 0 with K = sum of grad N^T grad N.
VectorXd solve(const TriangulationMesh& mesh) {
  FieldProblem problem(mesh, 1);
  TabulatedElement element;
  problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
    tabulate_cell(polygon, element);
    const auto weights = element.rule.weights.asDiagonal();
    K = element.dx.transpose() * weights * element.dx + element.dy.transpose() * weights * element.dy;
  });
  for (const BoundaryLine& line : mesh.boundary)
    problem.hold(line.vertices[0], 0, exact(mesh.vertices.col(line.vertices[0])));
  return problem.solve();
}

/// Of each cell: the integral of |grad u_h - grad u|^2.
VectorXd squared_energy_errors(const TriangulationMesh& mesh, const VectorXd& u) {
  VectorXd errors = VectorXd::Zero(mesh.n_cells());
  TabulatedElement element;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    tabulate_cell(mesh.outline(c), element);
    const VectorXd u_cell = u(mesh.cell(c));
    for (Index q = 0; q < element.n_points(); ++q) {
      const Vec2 gradient(element.dx.row(q).dot(u_cell), element.dy.row(q).dot(u_cell));
      const Vec2 difference = gradient - exact_gradient(element.rule.points.col(q));
      errors[c] += element.rule.weights[q] * difference.squaredNorm();
    }
  }
  return errors;
}

/// A file for ParaView: u at the vertices and the error of each cell. Cells of the mesh are deal.II's active
/// ones in their order, so that values of cells need no translation.
void write(const dealii::DoFHandler<2>& dof_handler, const dealii::Vector<double>& u,
           const VectorXd& squared_errors) {
  dealii::DataOut<2> output;
  output.attach_dof_handler(dof_handler);
  output.add_data_vector(u, "u");
  const VectorXd errors = squared_errors.cwiseSqrt();
  const dealii::Vector<double> cell_errors(errors.begin(), errors.end());
  output.add_data_vector(cell_errors, "energy_error");
  output.build_patches();
  std::ofstream file("mesh_through_deal_ii.vtu");
  output.write_vtu(file);
}

/// The energy error when a mesh of at least `n_vertices` is reached, by halving all cells or some.
double error_with(int n_vertices, bool adaptive) {
  dealii::Triangulation<2> triangulation;
  dealii::GridGenerator::hyper_L(triangulation);
  triangulation.refine_global(2);
  dealii::DoFHandler<2> dof_handler(triangulation);
  for (;;) {
    const TriangulationMesh mesh = polygon_mesh(triangulation);
    const VectorXd u = solve(mesh);
    const VectorXd squared_errors = squared_energy_errors(mesh, u);
    const double error = std::sqrt(squared_errors.sum());
    std::cout << (adaptive ? "adaptive " : "uniform  ") << mesh.vertices.cols() << " vertices, "
              << mesh.indices.size() - 4 * mesh.n_cells() << " hanging, energy error " << error << '\n';

    dof_handler.distribute_dofs(dealii::FE_Q<2>(1));
    dealii::Vector<double> dofs;
    to_dofs(mesh, u, dof_handler, dofs);
    if (mesh.vertices.cols() >= n_vertices) {
      write(dof_handler, dofs, squared_errors);
      return error;
    }
    if (adaptive) {
      dealii::Vector<float> estimate(triangulation.n_active_cells());
      dealii::KellyErrorEstimator<2>::estimate(dof_handler, dealii::QGauss<1>(2), {}, dofs, estimate);
      dealii::GridRefinement::refine_and_coarsen_fixed_number(triangulation, estimate, 0.2, 0);
      triangulation.execute_coarsening_and_refinement();
    } else {
      triangulation.refine_global();
    }
  }
}

}  // namespace

int main() {
  const double uniform = error_with(2000, false), adaptive = error_with(2000, true);
  std::cout << "error of the uniform mesh over that of the adaptive one: " << uniform / adaptive << '\n';
  return uniform / adaptive > 3 && adaptive < 0.011 ? 0 : 1;
}
