#include <ddacontact/detection/broad_phase.hpp>

#include <ddacontact/core/sort_once.hpp>

#include <algorithm>
#include <cassert>
#include <numeric>

namespace ddacontact {

namespace {

/// Of so many boxes each is compared with each.
constexpr std::size_t few = 64;

/// Divides boxes by a line across an axis, in the middle of their low ends. False: it cuts too many.
bool divide(const std::vector<Box>& boxes, int axis, std::vector<int>& items, std::vector<int>& lower,
            std::vector<int>& upper) {
  const auto low_end = [&](int i) { return boxes[i].low[axis]; };
  const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
  std::ranges::nth_element(items, middle, {}, low_end);
  const double line = low_end(*middle);
  for (std::vector<int>* half : {&lower, &upper}) {
    half->clear();
    half->reserve(items.size());
  }
  for (int i : items) {
    if (low_end(i) < line) lower.push_back(i);
    if (boxes[i].high[axis] >= line) upper.push_back(i);
  }
  return !lower.empty() && upper.size() + lower.size() / 2 <= items.size();
}

/// Appends the pairs among these boxes, some perhaps twice.
void find_among(const std::vector<Box>& boxes, std::vector<int> items, std::vector<Pair>& found) {
  std::vector<int> lower, upper;
  if (items.size() > few) {
    Vec2 low = boxes[items.front()].low, high = low;
    for (int i : items) {
      low = low.cwiseMin(boxes[i].low);
      high = high.cwiseMax(boxes[i].low);
    }
    const int longer = high.x() - low.x() < high.y() - low.y() ? 1 : 0;
    for (int axis : {longer, 1 - longer})
      if (divide(boxes, axis, items, lower, upper)) {
        items = {};
        find_among(boxes, std::move(lower), found);
        return find_among(boxes, std::move(upper), found);
      }
  }
  for (std::size_t p = 0; p < items.size(); ++p)
    for (std::size_t q = 0; q < p; ++q)
      if (touch(boxes[items[p]], boxes[items[q]]))
        found.push_back({std::min(items[p], items[q]), std::max(items[p], items[q])});
}

}  // namespace

Box bounding_box(const PointsRef& polygon, double margin) {
  assert(polygon.cols() > 0);
  return widened({polygon.rowwise().minCoeff(), polygon.rowwise().maxCoeff()}, margin);
}

std::vector<Pair> overlapping_pairs(const std::vector<Box>& boxes) {
  std::vector<int> all(boxes.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Pair> found;
  find_among(boxes, std::move(all), found);
  sort_once(found);
  return found;
}

}  // namespace ddacontact
