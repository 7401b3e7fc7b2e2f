/// \file Values of a field in the cells of its mesh.
#pragma once

#include <polyfem/mesh/point_locator.hpp>

namespace polyfem {

/// What of its vertices a cell's shape functions belong to: corners, or corners and middles of edges in turn.
enum class CellOrder { linear, quadratic };

/// The values of a field u = (u1 v1 u2 v2 ...), of as many components as it has values a vertex, at the
/// vertices of a cell, as elements take them. Throws Error for a field of another mesh and a cell that is not
/// there.
VectorXd cell_values(const PolygonMesh& mesh, int cell, const Eigen::Ref<const VectorXd>& u);

/// A field at one point.
struct FieldAtPoint {
  VectorXd value;     ///< of each component
  MatrixXd gradient;  ///< a row a component, d / dx and d / dy
};

/// By the shape functions of the cell as they are (`suitable_basis`, without the gradient correction), at a
/// point of it as `PointLocator::nearest` finds it.
FieldAtPoint field_at(const PolygonMesh& mesh, const Eigen::Ref<const VectorXd>& u, const Located& there,
                      CellOrder order = CellOrder::linear);

}  // namespace polyfem
