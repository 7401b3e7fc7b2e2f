/// \file Which pairs of boxes touch.
#pragma once

#include <polyfem/core/types.hpp>

#include <array>
#include <vector>

namespace ddacontact {

using polyfem::PointsRef;
using polyfem::Vec2;

/// A rectangle along the axes, closed.
struct Box {
  Vec2 low, high;
};

/// The bounding box of a polygon, widened by `margin` on every side.
Box bounding_box(const PointsRef& polygon, double margin = 0);

/// Indices of two boxes, the smaller first.
using Pair = std::array<int, 2>;

/// Every pair (i < j) of boxes with a point in common, sorted. Uniform grid; boxes much larger than the
/// others are kept in a list of their own. O(n) for boxes of like size.
std::vector<Pair> overlapping_pairs(const std::vector<Box>& boxes);

}  // namespace ddacontact
