/// \file Where two polygons with rounded corners touch or may touch within a step.
#pragma once

#include <ddacontact/block/rounded_corners.hpp>
#include <ddacontact/detection/narrow_phase.hpp>

namespace ddacontact {

/// Appends the contacts of a pair: circles of `a` against edges of `b` and the other way round, and circles
/// against circles.
///
/// Of a polygon whose corners are arcs, each point of the outline has one normal, so that a circle outside
/// has one nearest point: on the edge that its centre is over, or on the arc of the corner that it is between
/// the normals of. That is asked where the predicted motion ends, or, if it goes in deeper than half the two
/// radii, where it goes in. `choices`: the contacts whose circle may be over another part of the outline when
/// the step is solved.
void find_rounded_contacts(const Outline& a, const RoundedBlock& rounded_a, const Outline& b,
                           const RoundedBlock& rounded_b, const PairLimits& limits,
                           std::span<const EarlierContact> earlier, std::vector<VertexEdge>& contacts,
                           std::vector<Choice>& choices);

}  // namespace ddacontact
