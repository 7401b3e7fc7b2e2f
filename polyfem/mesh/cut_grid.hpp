/// \file Cut cells: a domain in the squares of a background grid.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

namespace polyfem {

/// The grid's squares inside the domain whole, those across its outline cut along it, to `suitable_basis`
/// polygons as any others. The corners of the domain are vertices to the bit, and so is where grid lines meet
/// the outline. A cell smaller than `smallest` squares is joined to the neighbour with the longest common
/// edge, where both make one simple polygon.
/// \param[in] domain   simple, in either orientation
/// \param[in] spacing  side of the squares, > 0, in the domain's unit
/// \param[in] corner   where a corner of some square lies
/// \param[in] smallest in [0, 1); 0 keeps all cells
/// Throws Error for other numbers, and for more than 10^7 squares.
PolygonMesh cut_grid(const PointsRef& domain, double spacing, const Vec2& corner, double smallest = 0.05);

}  // namespace polyfem
