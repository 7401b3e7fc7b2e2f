/// \file The faces of edges that meet at common vertices alone.
#pragma once

#include <polyfem/mesh/line_noding.hpp>

#include <span>
#include <vector>

namespace polyfem {

/// Half-edge 2e runs along edge e from its first vertex to its second, 2e + 1 back. Those with the same face
/// on their left follow each other in a walk around it. A face with holes has several walks.
struct FaceWalks {
  std::vector<int> walk_of;  ///< of each half-edge
  std::vector<int> offsets{0};
  std::vector<int> half_edges;  ///< walk w owns half_edges[offsets[w]] up to offsets[w + 1]

  int n_walks() const { return static_cast<int>(offsets.size()) - 1; }
  std::span<const int> walk(int w) const {
    return {half_edges.data() + offsets[w], half_edges.data() + offsets[w + 1]};
  }
};

/// All walks, in the order of their first half-edges.
FaceWalks walk_faces(const NodedLines& graph);

/// Where a half-edge starts.
inline int start_of(const NodedLines& graph, int half_edge) {
  const NodedLines::Edge& edge = graph.edges[half_edge / 2];
  return half_edge % 2 == 0 ? edge.from : edge.to;
}

/// Takes out the edges with the same face on both sides: dangling ones, and those that join two parts by
/// themselves. Returns how many of them are longer than `counted`.
int remove_bridges(NodedLines& graph, double counted = 0);

/// Joins every part of the graph to that of its first edge: from the leftmost vertex of each a horizontal
/// edge runs to the left, from the rightmost one to the right, as far as the next edge. A part that touches
/// the rest in one vertex alone is joined in another. Then every face has one walk, which passes no vertex
/// twice. The graph must have no bridges, and the part of the first edge surround all others. Returns how
/// many edges were added; their mark is `mark`.
int connect_parts(NodedLines& graph, int mark);

}  // namespace polyfem
