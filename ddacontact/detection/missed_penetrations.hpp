/// \file Missed penetrations: vertices whose paths lead into another polygon through one of its edges.
#pragma once

#include <ddacontact/detection/narrow_phase.hpp>

#include <vector>

namespace ddacontact {

/// A polygon before and after a motion; each vertex goes straight at constant speed.
struct MovingOutline {
  int block;
  PointsRef start, end;  ///< simple, counter-clockwise
};

/// Appends the vertices of `a` that penetrate `b`, with the edges they pass through, then those of `b`. At
/// the end such a vertex lies inside, further than `tolerance` (m) from the outline; at the start in front of
/// the edge, or no more than that behind it. Reflex vertices are left out.
void find_missed_penetrations(const MovingOutline& a, const MovingOutline& b, double tolerance,
                              std::vector<VertexEdge>& entries);

}  // namespace ddacontact
