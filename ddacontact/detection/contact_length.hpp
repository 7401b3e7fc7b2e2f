/// \file The length that a contact stands for.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// The length over which a vertex contact stands for two touching edges: half the overlap of its edge with
/// the neighbouring edge of its vertex that lies along it, of both where its vertex is on a straight line; 0
/// for a vertex alone on an edge. \param[in] unstrained  the polygon of the vertex before it was strained: it
/// has the lengths of its edges \param[in] at_any_angle  neighbouring edges that do not lie along it count
/// with their projections
double contact_length(const PointsRef& vertex_polygon, int vertex, const PointsRef& edge_polygon, int edge,
                      const PointsRef& unstrained, bool at_any_angle = false);

}  // namespace ddacontact
