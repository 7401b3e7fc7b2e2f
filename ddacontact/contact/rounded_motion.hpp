/// \file Gap and slip of rounded corners under motions of any size, and their derivatives.
///
/// The circle of a vertex lies on the segment from it to the next vertex. The gap is the distance of its
/// centre from the edge's line, or from a corner of the other block, less its radius. The slip is that of the
/// point of the circle which is nearest to the other block at the start of the step, so that a corner that
/// rolls does not slip.
#pragma once

#include <ddacontact/contact/edge_motion.hpp>
#include <ddacontact/core/segment_point.hpp>

namespace ddacontact {

/// A vertex and an edge with the vertex that follows i, or their motion.
struct RoundedPositions : VertexEdgePositions {
  Vec2 after_i{0, 0};
};

/// What touches in a contact of a rounded corner.
struct Rounding {
  SegmentPoint centre{}, surface{};  ///< of the vertex's circle, and the point that the slip is of: from i on
  SegmentPoint start{}, end{1, 0};  ///< of the line that it slips along, from j to k: the edge; of a corner a
                                    ///< line through it, half way, across the line to the circle's centre
  double radius = 0;                ///< m
  bool corner = false;              ///< whether it is against the corner j
  Vec2 after_i{0, 0};               ///< the vertex after i at the start of the step
  PointMap of_after_i{};            ///< and how it moves
};

/// The line of the slip and the vertex's point on it, as a vertex and an edge.
VertexEdgePositions slip_positions(const RoundedPositions& positions, const Rounding& rounding);

/// See the same of sharp corners; derivatives by all four positions.
GapAndSlip gap_and_slip(const RoundedPositions& start, const RoundedPositions& by, double lock,
                        Directions directions, const Rounding& rounding);

/// From the corner to the centre of the circle, or how fast that changes.
Vec2 from_corner(const RoundedPositions& positions, const Rounding& rounding);

}  // namespace ddacontact
