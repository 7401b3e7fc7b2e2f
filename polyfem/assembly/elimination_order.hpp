/// \file The order in which to eliminate the vertices of a mesh.
#pragma once

#include <polyfem/mesh/vertex_cells.hpp>

#include <span>
#include <vector>

namespace polyfem {

/// An order in which to eliminate the vertices of a mesh so that few entries arise: nested dissection by
/// their places (A. George, "Nested dissection of a regular finite element mesh", 1973). Cells are halved
/// again and again across the longer side of their bounding box; vertices with cells of both halves come
/// after all others of both. Within these bounds the order is one of minimum degree (CAMD). Meshes of some
/// hundreds of cells are not halved at all: minimum degree is as good there. Of 100 000 Voronoi cells with
/// two unknowns a vertex it leaves 5.5e7 entries and takes 2.9e10 operations, minimum degree alone 5.8e7
/// and 3.8e10.
///
/// \param[in] first, neighbour  vertices that share a cell: those from v on are neighbour[first[v]] ..
///                              neighbour[first[v + 1] - 1], ascending, v itself included
std::vector<int> elimination_order(const PolygonMesh& mesh, const VertexCells& cells_at,
                                   std::span<const int> first, std::span<const int> neighbour);

}  // namespace polyfem
