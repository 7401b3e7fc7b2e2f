/// \file The length that a contact stands for.
#pragma once

#include <ddacontact/detection/narrow_phase.hpp>

#include <functional>

namespace ddacontact {

/// The length of a contact, m. A vertex at an end of the edge, where a collinear one follows, stands for a
/// part of that too.
struct ContactLength {
  double on_edge = 0, beyond = 0;
  int edge_beyond = -1;  ///< the neighbour of the edge that `beyond` is on; -1: none

  double total() const { return on_edge + beyond; }
};

/// The length over which a vertex contact stands for two touching faces: half of the way to the next contact
/// on either side, at a vertex of either polygon, or to where one of the faces ends, so that the lengths of
/// all contacts of two faces add up to their overlap. 0 for a vertex alone on an edge. A corner stands for
/// the face of its own that lies along the edge, or is least inclined to it.
/// \param[in] unstrained    the polygon of the vertex before it was strained: it has the lengths of its edges
/// \param[in] bears         whether a vertex of this block has a contact with the other one
/// \param[in] at_any_angle  a face that does not lie along the edge counts with its projection
ContactLength contact_length(const PointsRef& vertex_polygon, const PointsRef& edge_polygon,
                             const VertexEdge& contact, const PointsRef& unstrained,
                             const std::function<bool(int block, int vertex)>& bears,
                             bool at_any_angle = false);

}  // namespace ddacontact
