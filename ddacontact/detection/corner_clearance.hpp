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

/// Distance of a point from the nearest point of a polygon's outline, m.
double distance_from_outline(const Vec2& point, const PointsRef& outline);

}  // namespace ddacontact
