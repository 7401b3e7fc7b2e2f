/// \file The corners of a block as arcs of circles.
#pragma once

#include <ddacontact/core/segment_point.hpp>

#include <vector>

namespace ddacontact {

/// One corner. Reflex corners stay sharp: theirs is the circle that touches the edge after them there.
struct RoundedCorner {
  SegmentPoint centre;  ///< of the circle, on the edge from the vertex to the next
  bool is_arc = false;  ///< whether the outline turns left there
};

/// All corners of a block, with the radius of their circles, m.
struct RoundedBlock {
  double radius = 0;
  std::vector<RoundedCorner> corners;

  /// The centre of a smaller circle in a corner.
  SegmentPoint centre(int v, double of_radius) const {
    const double part = of_radius / radius;
    return {part * corners[v].centre.x, part * corners[v].centre.y};
  }
  /// How much of the edges beside a corner an arc takes there, m.
  /// \param[in] length     of the edge after it, m
  /// \param[in] of_radius  of the arc, m
  double cut(int v, double length, double of_radius) const {
    return corners[v].centre.x * length * of_radius / radius;
  }
};
/// \param[in] outline  simple, counter-clockwise
RoundedBlock round_corners(const PointsRef& outline, double radius);

/// The largest radius, m, with which no edge is used up by the circles at its two ends, and that edge.
struct LargestRounding {
  double radius;
  int edge;
};
/// \param[in] outline  simple, counter-clockwise
LargestRounding largest_rounding(const PointsRef& outline);

}  // namespace ddacontact
