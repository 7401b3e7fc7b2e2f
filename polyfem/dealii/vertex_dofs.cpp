#include <polyfem/core/error.hpp>
#include <polyfem/dealii/vertex_dofs.hpp>

#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>
#include <deal.II/lac/vector.h>

#include <string>

namespace polyfem {
namespace {

using DoFHandler = dealii::DoFHandler<2>;
using dealii::types::global_dof_index;

void require_same_triangulation(const TriangulationMesh& mesh,
                                const dealii::Triangulation<2>& triangulation) {
  const auto n_cells = static_cast<int>(triangulation.n_active_cells());
  if (n_cells != mesh.n_cells() || triangulation.n_vertices() != mesh.mesh_vertex.size())
    throw Error("the mesh has " + std::to_string(mesh.n_cells()) + " cells, the triangulation " +
                std::to_string(n_cells) +
                ": it is another one or was refined since; make the mesh anew with polygon_mesh");
}

void require_vertex_unknowns(const dealii::FiniteElement<2>& element) {
  const unsigned n = element.n_components();
  if (!element.is_primitive() || element.n_dofs_per_vertex() != n ||
      element.n_dofs_per_cell() != n * element.reference_cell().n_vertices())
    throw Error(element.get_name() +
                " does not have one unknown per vertex and component, as values at vertices need; take "
                "FE_Q(1), FE_SimplexP(1) or an FESystem of these");
}

/// The degree of freedom of each value, in the order d = (u1 v1 u2 v2 ...) of the mesh's vertices.
std::vector<global_dof_index> dofs_of_values(const TriangulationMesh& mesh, const DoFHandler& dof_handler) {
  require_same_triangulation(mesh, dof_handler.get_triangulation());
  for (const auto& element : dof_handler.get_fe_collection()) require_vertex_unknowns(element);
  const std::size_t n_components = dof_handler.get_fe_collection().n_components();
  std::vector<global_dof_index> result(n_components * mesh.triangulation_vertex.size());
  std::vector<global_dof_index> cell_dofs;
  for (const auto& cell : dof_handler.active_cell_iterators()) {
    cell_dofs.resize(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(cell_dofs);
    for (unsigned i = 0; i < cell_dofs.size(); ++i) {
      const auto [component, corner] = cell->get_fe().system_to_component_index(i);
      result[n_components * mesh.mesh_vertex[cell->vertex_index(corner)] + component] = cell_dofs[i];
    }
  }
  return result;
}

void require_count(Index n, std::size_t expected, const char* what) {
  if (n != static_cast<Index>(expected))
    throw Error(std::to_string(n) + " " + what + ", but the mesh and the element ask for " +
                std::to_string(expected));
}

}  // namespace

void to_dofs(const TriangulationMesh& mesh, const VectorXd& values, const DoFHandler& dof_handler,
             dealii::Vector<double>& dofs) {
  const std::vector<global_dof_index> place = dofs_of_values(mesh, dof_handler);
  require_count(values.size(), place.size(), "values");
  dofs.reinit(dof_handler.n_dofs());
  for (std::size_t i = 0; i < place.size(); ++i) dofs[place[i]] = values[static_cast<Index>(i)];
}

VectorXd from_dofs(const TriangulationMesh& mesh, const DoFHandler& dof_handler,
                   const dealii::Vector<double>& dofs) {
  const std::vector<global_dof_index> place = dofs_of_values(mesh, dof_handler);
  require_count(static_cast<Index>(dofs.size()), dof_handler.n_dofs(), "degrees of freedom");
  VectorXd values(static_cast<Index>(place.size()));
  for (std::size_t i = 0; i < place.size(); ++i) values[static_cast<Index>(i)] = dofs[place[i]];
  return values;
}

}  // namespace polyfem
