/// \file Gap and slip of rounded corners under motions of any size, and their derivatives.
///
/// The circle of a vertex lies on the segment from it to the next vertex. The gap is the distance of its
/// centre from the edge's line, or from the centre of the other corner's circle, less their radii. The slip is
/// that of the point of the circle which is nearest to the other block at the start of the step, so that a
/// corner that rolls does not slip.
#pragma once

#include <ddacontact/contact/edge_motion.hpp>
#include <ddacontact/core/segment_point.hpp>

namespace ddacontact {

/// A vertex and an edge with the vertex that follows i, or their motion.
struct RoundedPositions : VertexEdgePositions {
  Vec2 after_i{0, 0};
};

/// Circle of a rounded corner in a contact, and the line along which it slips.
struct Rounding {
  /// Centre of the vertex's circle, tied to the segment from i to the vertex after it.
  SegmentPoint centre{};
  /// Point of the circle whose slip is measured, tied to the same segment.
  SegmentPoint surface{};
  /// Ends of the line of the slip, tied to the segment from j to k. Against an edge the line is the edge;
  /// against a corner its middle is where its circle is touched, and it is normal to the line through both
  /// centres.
  SegmentPoint start{}, end{1, 0};
  /// Centre of the circle of the corner j, tied to the same segment.
  SegmentPoint other_centre{};
  /// Radius of the circle and, against a corner, that of the other one's on top, m.
  double radius = 0;
  /// Whether the circle touches the corner j, not the edge.
  bool corner = false;
};

/// The line of the slip and the vertex's point on it, as a vertex and an edge.
VertexEdgePositions slip_positions(const RoundedPositions& positions, const Rounding& rounding);

/// Gap and slip as of sharp corners (contact/edge_motion.hpp), with derivatives by all four positions.
GapAndSlip gap_and_slip(const RoundedPositions& start, const RoundedPositions& by, double lock,
                        Directions directions, const Rounding& rounding);

/// Vector from the centre of the corner's circle to that of the vertex's, or its rate when given velocities.
Vec2 from_corner(const RoundedPositions& positions, const Rounding& rounding);

}  // namespace ddacontact
