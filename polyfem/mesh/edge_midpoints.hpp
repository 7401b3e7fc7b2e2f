/// \file Meshes of quadratic cells: a vertex in the middle of every edge.
#pragma once

#include <polyfem/mesh/mesh_boundary.hpp>

#include <array>
#include <span>
#include <vector>

namespace polyfem {

/// The mesh with the middle of each edge as a vertex, after the vertices it has, in the order in which cells
/// first come to them. Each cell lists a corner and the middle of the edge after it in turn, as
/// `evaluate_quadratic` takes them; `FieldProblem` and `MeshFile` take such a mesh as any other. Throws Error
/// for what `require_numbering` refuses.
PolygonMesh with_edge_midpoints(const PolygonMesh& mesh);

/// The edges (first, middle, last) of a mesh of quadratic cells that belong to one cell only and lie in a
/// region with these three vertices, in their cell's direction. Throws Error as `boundary_edges` does, and
/// for a cell with an odd number of vertices.
std::vector<std::array<int, 3>> quadratic_boundary_edges(const PolygonMesh& quadratic, const Region& region);

/// The edges (first, middle, last) of a mesh of quadratic cells for edges (first, last) between its corners,
/// as the groups of a NamedMesh have them. Throws Error for a pair that is no edge of a cell in that
/// direction.
std::vector<std::array<int, 3>> quadratic_edges(const PolygonMesh& quadratic,
                                                std::span<const std::array<int, 2>> edges);

}  // namespace polyfem
