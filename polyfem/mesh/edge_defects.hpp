/// \file Edges of a mesh that do not fit together.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <vector>

namespace polyfem {

/// An edge of a cell, in the cell's direction.
struct CellEdge {
  int from, to, cell;
};

/// Two cells on the same side of an edge.
struct EdgeOverlap {
  CellEdge edge;
  int other_cell;
};

/// The edges of one cell only, and those with two cells on the same side; `edges` in any order, of which all
/// but the directions may be reordered.
struct UnpairedEdges {
  std::vector<CellEdge> single;
  std::vector<EdgeOverlap> overlaps;
};
UnpairedEdges unpaired_edges(const std::vector<CellEdge>& edges, int n_vertices);

/// A vertex in an edge that does not have it: inside the edge, or at the place of one of its ends.
struct TouchingVertex {
  int vertex;
  CellEdge edge;
  int end;  ///< the end at whose place it is, or -1: inside
};

/// Ends of the given edges which are in another of them, within 1e-9 of its length.
std::vector<TouchingVertex> touching_vertices(const Points& vertices, const std::vector<CellEdge>& edges);

}  // namespace polyfem
