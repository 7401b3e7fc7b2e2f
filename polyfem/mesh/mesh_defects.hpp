/// \file What may be wrong with a mesh of polygons that share their vertices.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <string>
#include <vector>

namespace polyfem {

/// What may be wrong with a mesh.
enum class MeshFlaw {
  offsets,             ///< they do not divide the indices into cells; nothing else is looked at then
  too_few_vertices,    ///< a cell of less than three
  index_out_of_range,  ///< a vertex the mesh does not have
  repeated_vertex,     ///< twice in a cell, by its number or by its place
  not_finite,          ///< a coordinate
  no_area,             ///< all vertices of a cell on a line
  clockwise,           ///< a cell
  self_intersection,   ///< of a cell's outline
  overlap,         ///< of cells: they are on the same side of an edge, or their outlines lie on each other
  hanging_vertex,  ///< inside an edge of a cell that does not have it
  crack,           ///< two vertices at the same place
  unused_vertex    ///< in no cell
};

/// A defect of a mesh and where it shows.
struct MeshDefect {
  MeshFlaw flaw;
  int cell = -1;     ///< the cell concerned, or one of them; -1 when there is none
  int vertex = -1;   ///< the vertex concerned, or one of them; -1 when there is none
  std::string text;  ///< a sentence with cell, vertices, coordinates and cure
};

/// All defects of a mesh, by kinds in the order of MeshFlaw; none means that cells are simple polygons which
/// meet along whole edges only and do not overlap. Outlines that lie on each other without a common edge or a
/// touching vertex are looked for when there is no other misfit of edges, and the first place is named.
///
/// Places are the same within 1e-9 of the shortest edge there. Takes time in proportion to the mesh's size,
/// but for sorting what lies on the boundary.
std::vector<MeshDefect> find_defects(const PolygonMesh& mesh);

/// Throws Error with the defects of the mesh, if it has any: the first ten of them, and how many there are.
void require_valid(const PolygonMesh& mesh);

}  // namespace polyfem
