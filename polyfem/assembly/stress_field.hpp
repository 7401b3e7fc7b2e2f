/// \file The stresses and strains of a solved elastic problem, in one call.
#pragma once

#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/mesh/polygon_mesh.hpp>

#include <functional>
#include <vector>

namespace polyfem {

/// Strains (xx, yy, 2 xy) or stresses (xx, yy, xy), one a column.
struct TensorField {
  Tensors of_cells;     ///< means over each cell
  Tensors at_vertices;  ///< the linear fields nearest to each cell's, averaged around each vertex
  Tensors at_points;    ///< at the integration points of all cells
};

/// Stresses and strains, and where.
struct StressField {
  TensorField stress, strain;
  Points points;                   ///< of integration
  std::vector<Index> first_point;  ///< of each cell, and one more
};

/// Whether the element's stress follows its strain at each point, or the mean dilatation over it (B-bar, see
/// `b_bar_stiffness`). The strain that is given has the mean dilatation then, half of it in each direction.
enum class Dilatation { pointwise, mean };

/// Tabulates a cell. Give the function that the matrices were made with: then stresses are those whose forces
/// balance the loads, with the same rule and gradient correction.
using TabulateCell = std::function<void(int cell, const PointsRef& polygon, TabulatedElement& element)>;
/// The elasticity of a cell.
using CellElasticity = std::function<Mat3(int cell)>;

/// Strains, and stresses D epsilon, of displacements u = (u1 v1 u2 v2 ...) at the vertices of a mesh, of
/// cells of either order. At vertices stresses are exact where they are linear around; on meshes of Voronoi
/// cells of first order their error is a quarter or less of that of the stress of one cell there (see
/// `extrapolate_to_vertices`). Across an interface of two materials they are averaged too. Throws Error, with
/// the cell, for what `tabulate_cell` throws, and for displacements of the wrong size.
StressField stress_field(const PolygonMesh& mesh, const Eigen::Ref<const VectorXd>& u,
                         const TabulateCell& tabulate_cell, const CellElasticity& elasticity,
                         Dilatation dilatation = Dilatation::pointwise);

}  // namespace polyfem
