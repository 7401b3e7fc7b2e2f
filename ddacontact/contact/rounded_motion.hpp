/// \file Gap and slip of rounded corners under motions of any size, and their derivatives.
///
/// The circle of a vertex lies on the segment from it to the next vertex. Against an edge the gap is the
/// distance of its centre from the edge's line less its radius, against another circle the distance of the
/// two centres less both radii. The slip is that of the point of the circle which is nearest to the other
/// block at the start of the step, so that a corner that rolls does not slip.
#pragma once

#include <ddacontact/contact/edge_motion.hpp>
#include <ddacontact/core/segment_point.hpp>

namespace ddacontact {

/// What touches in a contact of a rounded corner.
struct Rounding {
  SegmentPoint centre{}, surface{};  ///< of the vertex's circle, and the point that the slip is of: from i on
  SegmentPoint start{}, end{1, 0};  ///< of the line that it slips along, from j to k: the edge, or of another
                                    ///< circle a line through its centre, half way, parallel to the tangent
  double radius = 0;                ///< of the circle, or of both, m
  bool corner = false;              ///< whether the other is a circle
};

/// The line of the slip and the vertex's point on it, as a vertex and an edge.
VertexEdgePlace slip_place(const VertexEdgePlace& place, const Rounding& rounding);

/// See the same of sharp corners; derivatives by all four places.
GapAndSlip gap_and_slip(const VertexEdgePlace& start, const VertexEdgePlace& by, double lock, bool mean,
                        const Rounding& rounding);

/// From the centre of the other circle of a corner to that of the vertex, or how fast that changes.
Vec2 between_centres(const VertexEdgePlace& place, const Rounding& rounding);

}  // namespace ddacontact
