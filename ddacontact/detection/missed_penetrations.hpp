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

/// Appends the vertices of `a` that penetrated `b`, with the edges they passed through, then those of `b`: not
/// reflex ones, at last in the other polygon further than `tolerance` (m) from its outline. Of the edge they
/// were at first in front, or no more than that behind.
void find_missed_penetrations(const MovingOutline& a, const MovingOutline& b, double tolerance,
                              std::vector<VertexEdge>& entries);

}  // namespace ddacontact
