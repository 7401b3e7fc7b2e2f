/// \file An order of a mesh's vertices in which a factor of their matrix stays sparse.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <vector>

namespace polyfem {

/// The vertices in the order in which to eliminate them: nested dissection by coordinates.
///
/// Cells are halved at the median of their centres across the longer side of their bounding box, the halves
/// halved again down to a few cells. Vertices that belong to cells of both halves separate them: what is left
/// in one is not coupled to what is left in the other. Each half's own vertices come before those of the cut.
std::vector<int> nested_dissection(const PolygonMesh& mesh);

}  // namespace polyfem
