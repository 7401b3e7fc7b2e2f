/// \file A deal.II triangulation as a mesh of polygons.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <array>
#include <vector>

/// Declared here so that deal.II's headers, 17 s of compilation, are paid by those who include them.
namespace dealii {
template <int, int>
class Triangulation;
}

namespace polyfem {

/// An edge of the boundary and the number deal.II has for it.
struct BoundaryLine {
  int cell;                     ///< of the mesh
  int edge;                     ///< of the cell, from its vertex `edge` to the next
  std::array<int, 2> vertices;  ///< of the mesh, in the cell's direction
  unsigned boundary_id;
};

/// The active cells of a triangulation as polygons, cell c being the one with active_cell_index() == c. So
/// values of cells are already in the order of the vectors that dealii::DataOut takes for cells.
struct TriangulationMesh : PolygonMesh {
  std::vector<unsigned> triangulation_vertex;  ///< deal.II's number of each vertex of the mesh, increasing
  std::vector<int> mesh_vertex;                ///< the inverse: -1 for those without an active cell
  std::vector<unsigned> material_ids;          ///< of each cell
  std::vector<BoundaryLine> boundary;          ///< cell after cell
};

/// Takes over vertices and active cells, quadrilaterals and triangles; vertices without a cell are left out.
/// A hanging node is a vertex of the larger cell too, so that the mesh is conforming: a straight corner,
/// which Wachspress functions cannot have and mean value functions can. Edges are straight, as in deal.II
/// with its linear mapping; where a hanging node was moved off the line the larger cell follows it without a
/// gap.
///
/// Cells come out counter-clockwise however deal.II has them. Of a distributed triangulation all active cells
/// this process knows are taken, artificial ones included.
TriangulationMesh polygon_mesh(const dealii::Triangulation<2, 2>& triangulation);

}  // namespace polyfem
