/// \file Which pairs of boxes touch.
#pragma once

#include <ddacontact/core/types.hpp>

#include <array>
#include <vector>

namespace ddacontact {

/// A rectangle along the axes, closed.
struct Box {
  Vec2 low, high;
};

/// Whether two boxes have a point in common.
inline bool touch(const Box& a, const Box& b) {
  return a.low.x() <= b.high.x() && b.low.x() <= a.high.x() && a.low.y() <= b.high.y() &&
         b.low.y() <= a.high.y();
}

/// A box that is moved.
inline Box shifted(const Box& box, const Vec2& by) {
  return {box.low + by, box.high + by};
}
/// A box that is wider on every side.
inline Box widened(const Box& box, double margin) {
  return {box.low.array() - margin, box.high.array() + margin};
}
/// The smallest box around two.
inline Box joined(const Box& a, const Box& b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

/// The bounding box of a polygon, widened by `margin` on every side.
Box bounding_box(const PointsRef& polygon, double margin = 0);

/// Indices of two boxes, the smaller first.
using Pair = std::array<int, 2>;

/// Every pair (i < j) of boxes with a point in common, sorted.
///
/// The boxes are halved by a line across the longer side of their common box, again and again until few are
/// left; those that the line cuts go with both halves. O(n log n) for boxes that are spread out, whatever
/// their sizes.
std::vector<Pair> overlapping_pairs(const std::vector<Box>& boxes);

}  // namespace ddacontact
