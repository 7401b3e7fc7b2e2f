/// \file Which vertices of a mesh lie where on the outline of its domain.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <optional>
#include <vector>

namespace polyfem {

/// Where a vertex may be: at a corner of the domain, on an edge of it, or (neither) inside.
struct BoundaryPosition {
  int corner = -1, edge = -1;  ///< -1: none; a vertex at a corner has no edge

  bool inside() const { return corner < 0 && edge < 0; }
};

/// The edge of a domain with `n_corners` corners on which both vertices lie, their corners counted; nothing
/// when there is none.
std::optional<int> common_edge(const BoundaryPosition& a, const BoundaryPosition& b, int n_corners);

/// Finds where the vertices of a mesh are, and moves those at corners of the domain exactly there. Throws
/// Error for an edge of one cell only that is not part of the outline, and for a corner without a vertex.
/// \param[in] domain     counter-clockwise
/// \param[in] tolerance  how far a vertex on the outline may lie from it
std::vector<BoundaryPosition> boundary_positions(PolygonMesh& mesh, const PointsRef& domain,
                                                 double tolerance);

}  // namespace polyfem
