/// \file Where two polygons touch or may touch within a step: vertices against edges.
#pragma once

#include <ddacontact/core/types.hpp>
#include <ddacontact/detection/outline_table.hpp>

#include <compare>
#include <span>
#include <vector>

namespace ddacontact {

/// A vertex of one block and the edge of another that it may meet. Edge k runs from vertex k to vertex k + 1.
struct VertexEdge {
  int vertex_block = 0, vertex = 0, edge_block = 0, edge = 0;
  auto operator<=>(const VertexEdge&) const = default;
};

/// One of the two polygons of a pair.
struct Outline {
  int block;
  PointsRef vertices;  ///< simple, counter-clockwise
};

/// Lengths by which the contacts of two polygons are chosen, m.
struct PairLimits {
  double reach;        ///< pairs of features further apart than this cannot meet within the step
  double max_depth;    ///< a vertex deeper inside than this did not come through this edge
  double coincidence;  ///< two vertices no further apart along the edge than this count as one place
};

/// Appends the contacts of a pair to `contacts`: the vertices of `a` on edges of `b`, then those of `b`.
///
/// A vertex may enter through an edge on whose outer side its whole corner lies; a reflex one through none.
/// Of edges that go straight on into each other it meets the one it is over. A vertex may enter a convex
/// polygon through one edge only, the one with the largest gap, as it is outside as long as it is beyond one
/// edge. So it is with edges of any polygon between which the outline turns left; edges with a reflex corner
/// between them, as the two of a notch, are met each. Whether a vertex is outside is decided exactly, up to
/// `coincidence`: then it meets no edge that it is behind. One inside came in through the nearest edge, or
/// one that was closed before, and of edges that it is behind meets besides only the other one of a notch.
///
/// Two touching edges come out as the two ends of their overlap; where vertex meets vertex the two corners'
/// entrance edges are compared, and one stays. `kept` are contacts of this pair that were closed before:
/// where the choice is a tie they win, so that a resting contact keeps its lock point.
void find_contacts(const Outline& a, const Outline& b, const PairLimits& limits,
                   std::span<const VertexEdge> kept, std::vector<VertexEdge>& contacts);
/// The same where the sides are known; their boxes are relative to the origin of the vertices.
void find_contacts(const Outline& a, const OutlineSides& of_a, const Outline& b, const OutlineSides& of_b,
                   const PairLimits& limits, std::span<const VertexEdge> kept,
                   std::vector<VertexEdge>& contacts);

/// The length over which a vertex contact stands for two touching edges: half the overlap of its edge with
/// the neighbouring edge of its vertex that lies along it, of both where its vertex is on a straight line; 0
/// for a vertex alone on an edge.
double contact_length(const PointsRef& vertex_polygon, int vertex, const PointsRef& edge_polygon, int edge);

}  // namespace ddacontact
