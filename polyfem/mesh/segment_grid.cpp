#include <polyfem/mesh/segment_grid.hpp>

#include <algorithm>
#include <cmath>

namespace polyfem {

namespace {

constexpr double margin = 1e-6;  // of a square

}  // namespace

SegmentGrid::SegmentGrid(const std::vector<Segment>& segments, double n_squares) {
  low_ = segments.front().from;
  Vec2 high = low_;
  for (const Segment& s : segments) {
    low_ = low_.cwiseMin(s.from).cwiseMin(s.to);
    high = high.cwiseMax(s.from).cwiseMax(s.to);
  }
  const Vec2 box = (high - low_).cwiseMax((high - low_).maxCoeff() / n_squares);
  size_ = std::sqrt(box.x() * box.y() / n_squares);
  n_columns_ = static_cast<int>(box.x() / size_) + 1;
  n_rows_ = static_cast<int>(box.y() / size_) + 1;

  const std::size_t n = static_cast<std::size_t>(n_columns_) * n_rows_;
  first_.assign(n + 1, 0);
  for (const Segment& s : segments) walk(s, [&](std::size_t square) { ++first_[square + 1]; });
  for (std::size_t square = 0; square < n; ++square) first_[square + 1] += first_[square];
  segments_.resize(first_[n]);
  std::vector<int> end(first_.begin(), first_.end() - 1);
  for (std::size_t k = 0; k < segments.size(); ++k)
    walk(segments[k], [&](std::size_t square) { segments_[end[square]++] = static_cast<int>(k); });
}

int SegmentGrid::column(double x) const {
  return std::clamp(static_cast<int>(std::floor((x - low_.x()) / size_)), 0, n_columns_ - 1);
}

int SegmentGrid::row(double y) const {
  return std::clamp(static_cast<int>(std::floor((y - low_.y()) / size_)), 0, n_rows_ - 1);
}

template <class Visit>
void SegmentGrid::walk(const Segment& segment, Visit&& visit) const {
  Vec2 a = segment.from, b = segment.to;
  if (a.x() > b.x()) std::swap(a, b);
  const double reach = margin * size_, width = b.x() - a.x();
  const int last = column(b.x() + reach);
  for (int c = column(a.x() - reach); c <= last; ++c) {
    const auto y_at = [&](double x) {
      return width > 0 ? a.y() + std::clamp((x - a.x()) / width, 0.0, 1.0) * (b.y() - a.y()) : a.y();
    };
    const double left = low_.x() + c * size_ - reach;
    double y = y_at(left), other = width > 0 ? y_at(left + size_ + 2 * reach) : b.y();
    if (y > other) std::swap(y, other);
    const int top = row(other + reach);
    for (int r = row(y - reach); r <= top; ++r) visit(static_cast<std::size_t>(r) * n_columns_ + c);
  }
}

std::span<const int> SegmentGrid::near(const Vec2& point) const {
  const std::size_t square = static_cast<std::size_t>(row(point.y())) * n_columns_ + column(point.x());
  return {segments_.data() + first_[square], segments_.data() + first_[square + 1]};
}

}  // namespace polyfem
