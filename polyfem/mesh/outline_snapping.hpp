/// \file Polygons with rounded coordinates made to touch.
#pragma once

#include <polyfem/core/types.hpp>

#include <optional>
#include <vector>

namespace polyfem {

/// What snapping came to.
struct Snapping {
  int n_moved = 0;               ///< vertices
  double farthest = 0;           ///< of them, how far
  std::optional<int> collapsed;  ///< a polygon two vertices of which would become one; nothing was moved then
};

/// Vertices within `distance` of each other become one, at the place of the first; then a vertex within it of
/// an edge of another polygon moves onto that edge. Vertices keep their numbers.
Snapping snap_outlines(std::vector<Points>& outlines, double distance);

}  // namespace polyfem
