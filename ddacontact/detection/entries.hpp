/// \file Which vertices went into another polygon through one of its edges, by their paths.
#pragma once

#include <ddacontact/detection/narrow_phase.hpp>

#include <vector>

namespace ddacontact {

/// A polygon before and after a motion; each vertex goes straight at constant speed.
struct MovingOutline {
  int block;
  PointsRef start, end;  ///< simple, counter-clockwise
};

/// Appends the vertices of `a` that went through an edge of `b`, then those of `b` through `a`: not reflex
/// ones, at first no more than `tolerance` (m) behind the edge, at last more than that behind it, over it and
/// in between through it.
void find_entries(const MovingOutline& a, const MovingOutline& b, double tolerance,
                  std::vector<VertexEdge>& entries);

}  // namespace ddacontact
