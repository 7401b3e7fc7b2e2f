/// \file Cut cells: a domain, with holes, in the squares of a background grid.
#pragma once

#include <polyfem/mesh/named_mesh.hpp>

#include <map>
#include <string>
#include <vector>

namespace polyfem {

/// A side of a domain: from corner `corner` of a ring to the next; ring 0 is the outline, k the k-th hole
/// counted from one.
struct DomainSide {
  int ring, corner;
};

/// What is to be meshed.
struct GridDomain {
  Points outline;             ///< simple, in either orientation
  std::vector<Points> holes;  ///< the same each; inside the outline and apart from each other
  std::map<std::string, std::vector<DomainSide>> sides;  ///< named groups of sides: groups of edges
};

/// The grid's squares inside the domain whole, those across its outline or holes cut along them, to
/// `suitable_basis` polygons as any others. The corners of the domain are vertices to the bit, and so is
/// where grid lines meet its sides. A cell smaller than `smallest` squares is joined to the neighbour with
/// the longest common edge, where both make one simple polygon. A hole inside one square divides it by
/// horizontal edges to its left and right.
/// \param[in] spacing  side of the squares, > 0, in the domain's unit
/// \param[in] corner   where a corner of some square lies
/// \param[in] smallest in [0, 1); 0 keeps all cells
/// Throws Error for other numbers, for more than 10^7 squares, for rings that are not simple, cross each
/// other or lie outside, and for a named side that is not there.
NamedMesh cut_grid(const GridDomain& domain, double spacing, const Vec2& corner, double smallest = 0.05);

/// The same of a domain without holes or names.
PolygonMesh cut_grid(const PointsRef& outline, double spacing, const Vec2& corner, double smallest = 0.05);

}  // namespace polyfem
