// A square of four cells, one of them refined: 7 cells, 14 vertices, two of them hanging.
#include <polyfem/dealii/vertex_dofs.hpp>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/vector.h>

#include <iostream>

int main() {
  dealii::Triangulation<2> triangulation;
  dealii::GridGenerator::subdivided_hyper_cube(triangulation, 2);
  triangulation.begin_active()->set_refine_flag();
  triangulation.execute_coarsening_and_refinement();
  const polyfem::TriangulationMesh mesh = polyfem::polygon_mesh(triangulation);

  dealii::DoFHandler<2> dof_handler(triangulation);
  dof_handler.distribute_dofs(dealii::FE_Q<2>(1));
  dealii::Vector<double> dofs;
  to_dofs(mesh, mesh.vertices.row(0).transpose(), dof_handler, dofs);
  std::cout << mesh.n_cells() << " cells, " << mesh.vertices.cols() << " vertices, mean x "
            << dofs.mean_value() << '\n';
  return mesh.n_cells() == 7 && mesh.vertices.cols() == 14 && mesh.indices.size() == 7 * 4 + 2 ? 0 : 1;
}
