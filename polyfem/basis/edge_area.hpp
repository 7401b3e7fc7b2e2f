/// \file Twice the area of the triangle of a point and an edge, A(x, v_k, v_k+1), for several points at once.
///
/// With the edge e and either of its ends v it is cross(v - x, e). Rounded once per operation it errs by
/// eps |v - x| |e|, so the distance of x to the edge's line by eps |v - x|. That is all one needs unless
/// shape functions vary over much shorter distances than an edge is long: at nearly straight corners, at an
/// edge much shorter than its neighbours, in needles.
#pragma once

#include <polyfem/basis/lanes.hpp>

namespace polyfem {

/// The area by plain arithmetic.
class PlainEdge {
 public:
  static constexpr bool any_shape = false;  ///< good for well-shaped polygons only

  PlainEdge(const Vec2& from, const Vec2& to)
      : from_(in_all_lanes(from)), direction_(in_all_lanes(Vec2(to - from))) {}

  Lanes area(const LaneVector& x) const { return cross(from_ - x, direction_); }
  const LaneVector& from() const { return from_; }
  const LaneVector& direction() const { return direction_; }

 private:
  LaneVector from_, direction_;
};

/// Of the directions of both.
inline Lanes cross(const PlainEdge& a, const PlainEdge& b) {
  return cross(a.direction(), b.direction());
}

/// A number as `high`, of 26 bits, and `low`, what is missing to all of its 53 bits and those rounded off.
struct Split {
  Lanes high, low;
};

/// a - b without its round-off, split by T. J. Dekker's method ("A floating-point technique for extending the
/// available precision", 1971).
inline Split exact_difference(const Lanes& a, const Lanes& b) {
  const Lanes difference = a - b, b_seen = a - difference;
  const Lanes rounded_off = (a - (difference + b_seen)) + (b_seen - b);
  const Lanes shifted = 134217729. * difference;  // 2^27 + 1
  const Lanes high = shifted - (shifted - difference);
  return {high, (difference - high) + rounded_off};
}

/// A vector whose components are split.
struct SplitVector {
  Split x, y;
};

/// a - b without its round-off.
inline SplitVector exact_difference(const LaneVector& a, const LaneVector& b) {
  return {exact_difference(a.x, b.x), exact_difference(a.y, b.y)};
}

/// The cross product with an error of eps times itself and 2^-79 |a| |b|: products of high parts are exact,
/// and only they cancel.
inline Lanes cross(const SplitVector& a, const SplitVector& b) {
  return (a.x.high * b.y.high - a.y.high * b.x.high) +
         ((a.x.high * b.y.low - a.y.high * b.x.low) +
          (a.x.low * (b.y.high + b.y.low) - a.y.low * (b.x.high + b.x.low)));
}

/// The area without cancellation, from the nearer end.
class PreciseEdge {
 public:
  static constexpr bool any_shape = true;

  PreciseEdge(const Vec2& from, const Vec2& to)
      : from_(in_all_lanes(from)),
        to_(in_all_lanes(to)),
        direction_(to_ - from_),
        split_direction_(exact_difference(to_, from_)) {}

  Lanes area(const LaneVector& x) const {
    const LaneVector to_from = from_ - x, to_to = to_ - x;
    const auto nearer = dot(to_to, to_to) < dot(to_from, to_from);
    const LaneVector end{nearer ? to_.x : from_.x, nearer ? to_.y : from_.y};
    return cross(exact_difference(end, x), split_direction_);
  }
  const LaneVector& from() const { return from_; }
  const LaneVector& direction() const { return direction_; }
  const SplitVector& split_direction() const { return split_direction_; }

 private:
  LaneVector from_, to_, direction_;
  SplitVector split_direction_;
};

/// Of the directions of both, without cancellation.
inline Lanes cross(const PreciseEdge& a, const PreciseEdge& b) {
  return cross(a.split_direction(), b.split_direction());
}

}  // namespace polyfem
