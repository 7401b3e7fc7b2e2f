/// \file Coordinates in which the numbers of a mesh generator are moderate.
#pragma once

#include <polyfem/core/types.hpp>

#include <cmath>

namespace polyfem {

/// Moves a point to the origin and divides lengths by a power of two, so that only the shift is rounded.
class LocalFrame {
 public:
  /// \param[in] length  what is to have a length between 1 and 2
  LocalFrame(const Vec2& origin, double length)
      : origin_(origin), scale_(std::exp2(std::floor(std::log2(length)))) {}

  Points to_local(const PointsRef& points) const { return (points.colwise() - origin_) / scale_; }
  Vec2 to_world(const Vec2& point) const { return origin_ + scale_ * point; }

 private:
  Vec2 origin_;
  double scale_;
};

}  // namespace polyfem
