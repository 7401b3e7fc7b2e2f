/// \file A point that goes with a segment as if drawn on it.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// p + x (q - p) + y (q - p turned left) for a segment from p to q: linear in both, and exact when they turn.
struct SegmentPoint {
  double x = 0, y = 0;

  Vec2 from_p(const Vec2& along) const {
    return {x * along.x() - y * along.y(), x * along.y() + y * along.x()};
  }
  Vec2 at(const Vec2& p, const Vec2& q) const { return p + from_p(q - p); }
  /// The derivative by q of gradient . at(p, q); the one by p is the rest of the gradient.
  Vec2 by_q(const Vec2& gradient) const {
    return {x * gradient.x() + y * gradient.y(), x * gradient.y() - y * gradient.x()};
  }
  /// The one that is at `place` now.
  static SegmentPoint that_is_at(const Vec2& place, const Vec2& p, const Vec2& q) {
    const Vec2 along = q - p, to = place - p;
    return {along.dot(to) / along.squaredNorm(), cross(along, to) / along.squaredNorm()};
  }
};

}  // namespace ddacontact
