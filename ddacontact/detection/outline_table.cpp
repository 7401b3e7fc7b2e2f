#include <ddacontact/detection/outline_table.hpp>

namespace ddacontact {

OutlineTable::OutlineTable(std::span<const int> n_vertices) {
  for (const int n : n_vertices) first_.push_back(first_.back() + n);
  sides_.resize(first_.back());
  boxes_.resize(n_vertices.size());
  concave_.resize(n_vertices.size());
}

void OutlineTable::set(int polygon, const PointsRef& vertices) {
  Side* const sides = sides_.data() + first_[polygon];
  const int n = static_cast<int>(vertices.cols());
  Vec2 low = vertices.col(0), high = low, before = low - vertices.col(n - 1);
  bool concave = false;
  for (int k = 0; k < n; ++k) {
    const Vec2 x = vertices.col(k), along = vertices.col(next(k, vertices)) - x;
    const double length = along.norm();
    sides[k] = {along / length, length, turn_between(before, along)};
    concave = concave || polyfem::cross(before, along) < 0;
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
    before = along;
  }
  boxes_[polygon] = {low, high};
  concave_[polygon] = concave;
}

}  // namespace ddacontact
