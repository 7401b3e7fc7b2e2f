/// \file Whether the vertices of a block make a polygon that can be computed with.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <string>

namespace ddacontact::scene_format {

struct CheckedOutline {
  Points polygon;       ///< counter-clockwise; without columns when the outline is not valid
  double size = 0;      ///< square root of the area, m
  bool turned = false;  ///< given clockwise

  bool valid() const { return polygon.cols() > 0; }
  /// How far a point lies outside, m; 0 inside and on the outline.
  double distance_outside(const Vec2& point) const;
};

/// At most this many vertices: the checks are quadratic in them.
inline constexpr int most_vertices = 1000;

/// Sine of the turning angle up to which a corner is straight.
inline constexpr double straight_turn = 1e-9;

/// Necks, spikes and slits narrower than this times the size of the block are lost in round-off.
inline constexpr double narrowest = 1e-9;
/// Cells of a mesh around a place narrower than this cannot be resolved.
inline constexpr double narrowest_of_mesh = 1e-6;

/// Simple, with an area, and nowhere narrower than `narrowest`: no vertex is that near to an edge, but to
/// those at the other end of an edge shorter than that. A clockwise outline is turned around. The model
/// wachspress wants strictly convex ones: every corner turns by more than `straight_turn`. `title` names the
/// block in messages.
CheckedOutline check_outline(const Outline& outline, BlockModel model, const KeyLocations& locations,
                             const std::string& title, ProblemList& problems);

/// Where an outline of any number of vertices is no simple polygon with an area a problem says why, at one of
/// its vertices or at `location`.
void check_simple(const Outline& outline, const SourceLocation& location, const std::string& title,
                  ProblemList& problems);

}  // namespace ddacontact::scene_format
