/// \file How far a corner sticks out of what is around it.
#pragma once

#include <ddacontact/core/types.hpp>

#include <algorithm>

namespace ddacontact {

/// Distances of a corner from other blocks, m: from the nearest, and from any but one.
class CornerClearance {
 public:
  void add(int block, double distance) {
    if (distance < nearest_) {
      second_ = nearest_;
      nearest_ = distance;
      block_ = block;
    } else {
      second_ = std::min(second_, distance);
    }
  }
  double without(int block) const { return block == block_ ? second_ : nearest_; }

 private:
  double nearest_ = inf, second_ = inf;
  int block_ = -1;
};

/// From a point to the nearest one of the edge from `start` to `end`, m.
double distance_to_edge(const Vec2& point, const Vec2& start, const Vec2& end);
/// From a point to the nearest one of an outline, m; also from inside.
double distance_to_outline(const Vec2& point, const PointsRef& outline);

}  // namespace ddacontact
