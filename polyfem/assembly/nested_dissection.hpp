/// \file A mesh cut into parts for a sparse factor.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <vector>

namespace polyfem {

/// The stage of elimination of each vertex, see `minimum_degree_order`: nested dissection by coordinates.
///
/// Cells are halved at the median of their centres across the longer side of their bounding box, then those
/// moved across the cut that make it shorter, and the halves halved again down to some hundred cells.
/// Vertices that belong to cells of both halves separate them: what is left in one is not coupled to what is
/// left in the other. Each half's own vertices come at earlier stages than those of the cut.
std::vector<int> nested_dissection(const PolygonMesh& mesh);

}  // namespace polyfem
