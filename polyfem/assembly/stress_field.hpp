/// \file The stresses of a solved elastic problem, in one call.
#pragma once

#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/mesh/polygon_mesh.hpp>

#include <functional>

namespace polyfem {

/// Stresses (xx, yy, xy), one a column.
struct StressField {
  Tensors of_cells;     ///< means over each cell
  Tensors at_vertices;  ///< the linear fields nearest to each cell's stress, averaged around each vertex
};

/// Tabulates a cell. Give the function that the matrices were made with: then stresses are those whose forces
/// balance the loads, with the same rule and gradient correction.
using TabulateCell = std::function<void(int cell, const PointsRef& polygon, TabulatedElement& element)>;
/// The elasticity of a cell.
using CellElasticity = std::function<Mat3(int cell)>;

/// D epsilon of displacements u = (u1 v1 u2 v2 ...) at the vertices of a mesh, of cells of either order. At
/// vertices stresses are exact where they are linear around; on meshes of Voronoi cells of first order their
/// error is a quarter or less of that of the stress of one cell there (see `extrapolate_to_vertices`). Across
/// an interface of two materials they are averaged too. Throws Error, with the cell, for what `tabulate_cell`
/// throws, and for displacements of the wrong size.
StressField stress_field(const PolygonMesh& mesh, const Eigen::Ref<const VectorXd>& u,
                         const TabulateCell& tabulate_cell, const CellElasticity& elasticity);

}  // namespace polyfem
