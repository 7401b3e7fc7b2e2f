/// \file Whether the vertices of a block make a polygon that this version can compute with.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <string>

namespace ddacontact::scene_format {

struct CheckedOutline {
  Points polygon;       ///< counter-clockwise; without columns when the outline is not sound
  double size = 0;      ///< square root of the area, m
  bool turned = false;  ///< given clockwise

  bool sound() const { return polygon.cols() > 0; }
  /// How far a point lies outside, m; 0 inside and on the outline.
  double distance_outside(const Vec2& point) const;
};

/// At most this many vertices: the checks are quadratic in them.
inline constexpr int most_vertices = 1000;

/// Strictly convex (each corner turns by more than 1e-9 as a sine), simple, with an area; a clockwise one is
/// turned around. `title` names the block in messages.
CheckedOutline check_outline(const Outline& outline, const Places& places, const std::string& title,
                             ProblemList& problems);

}  // namespace ddacontact::scene_format
