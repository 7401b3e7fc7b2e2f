/// \file Where two polygons with rounded corners touch or may touch within a step.
#pragma once

#include <ddacontact/block/rounded_corners.hpp>
#include <ddacontact/detection/narrow_phase.hpp>

namespace ddacontact {

/// A polygon with rounded corners; its sides are not used.
struct RoundedPolygon {
  const Outline& outline;
  const RoundedBlock& rounded;
  double radius;  ///< of its arcs in this pair, up to that of the block, m
  /// Radius with which the other one's arcs meet each corner, up to that, m: a corner at which other blocks go on
  /// is met sharp, so that a flush joint is no groove.
  std::span<const double> met_radii;
};

/// Appends the contacts of a pair: arcs of `a` against edges and corners of `b`, and the other way round.
///
/// The centre of an arc is over an edge, or between the normals of a corner that the arc faces: that is what
/// it meets, and the gap has one normal. It is asked where the predicted motion ends, or, if the arc goes in
/// deeper than half its radius, where it goes in. Choices: the contacts whose arc may be over another part
/// of the outline when the step is solved.
void find_rounded_contacts(const RoundedPolygon& a, const RoundedPolygon& b, const PairLimits& limits,
                           std::span<const EarlierContact> earlier, FoundContacts& found);

}  // namespace ddacontact
