/// \file Edges of a mesh that do not fit together.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <string>
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

/// What does not go with a second edge in the opposite direction.
struct UnpairedEdges {
  std::vector<CellEdge> single;  ///< edges of cells on one side only
  std::vector<EdgeOverlap>
      overlaps;  ///< each pair of cells on the same side of an edge, next to each other by number
};

/// Sorts edges out by counting: takes time in proportion to their number.
UnpairedEdges unpaired_edges(const std::vector<CellEdge>& edges, int n_vertices);

/// The two cells, their edge, and what to do, in a sentence.
std::string description(const EdgeOverlap& overlap, const PolygonMesh& mesh);

/// A vertex in an edge that does not have it: inside the edge, or at the place of one of its ends.
struct TouchingVertex {
  int vertex;
  CellEdge edge;
  int end;  ///< the end at whose place it is, or -1: inside
};

/// Ends of the given edges which are in another of them, within 1e-9 of its length and of `size`, the length
/// of the shortest edge at each vertex: vertices of a small cell are not at the same place.
std::vector<TouchingVertex> touching_vertices(const Points& vertices, const std::vector<CellEdge>& edges,
                                              const VectorXd& size);

}  // namespace polyfem
