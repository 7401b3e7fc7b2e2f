/// \file Values at the vertices of a mesh as degrees of freedom of deal.II, and back.
#pragma once

#include <polyfem/dealii/triangulation_mesh.hpp>

namespace dealii {
template <int, int>
class DoFHandler;
template <typename>
class Vector;
}  // namespace dealii

namespace polyfem {

/// Brings values at vertices to deal.II: for dealii::DataOut, dealii::VectorTools, or as a start vector.
///
/// Hanging nodes get their own values too. deal.II's functions on the larger cell do not see them: it is
/// drawn and integrated from its corners alone. Throws Error when the element is another one, or the
/// triangulation is not the mesh's.
/// \param[in] mesh         what `polygon_mesh` made of the handler's triangulation, unchanged since
/// \param[in] values       n_components x n_vertices, as d = (u1 v1 u2 v2 ...)
/// \param[in] dof_handler  with one unknown per vertex and component: FE_Q(1), FE_SimplexP(1), or an FESystem
///                         of such; on meshes of both kinds of cells, a collection of them
/// \param[out] dofs        resized
void to_dofs(const TriangulationMesh& mesh, const VectorXd& values,
             const dealii::DoFHandler<2, 2>& dof_handler, dealii::Vector<double>& dofs);

/// The other way: values at the vertices, n_components x n_vertices, from degrees of freedom. Throws as
/// `to_dofs` does.
VectorXd from_dofs(const TriangulationMesh& mesh, const dealii::DoFHandler<2, 2>& dof_handler,
                   const dealii::Vector<double>& dofs);

}  // namespace polyfem
