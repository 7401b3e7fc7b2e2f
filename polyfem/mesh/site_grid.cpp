#include <polyfem/mesh/site_grid.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace polyfem {

SiteGrid::SiteGrid(const Points& sites, const Vec2& low, const Vec2& high) : low_(low) {
  const Vec2 extent = high - low;
  const double n = static_cast<double>(sites.cols());
  size_ = std::max(std::sqrt(extent.prod() / n), extent.maxCoeff() / (n + 1));
  n_columns_ = static_cast<int>(extent.x() / size_) + 1;
  n_rows_ = static_cast<int>(extent.y() / size_) + 1;

  const auto square = [&](Index i) { return row(sites(1, i)) * n_columns_ + column(sites(0, i)); };
  starts_.assign(static_cast<std::size_t>(n_columns_) * n_rows_ + 1, 0);
  for (Index i = 0; i < sites.cols(); ++i) ++starts_[square(i) + 1];
  for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  std::vector<int> next(starts_.begin(), starts_.end() - 1);
  indices_.resize(sites.cols());
  sites_.resize(2, sites.cols());
  for (Index i = 0; i < sites.cols(); ++i) {
    const int position = next[square(i)]++;
    indices_[position] = static_cast<int>(i);
    sites_.col(position) = sites.col(i);
  }
}

int SiteGrid::column(double x) const {
  return std::clamp(static_cast<int>((x - low_.x()) / size_), 0, n_columns_ - 1);
}

int SiteGrid::row(double y) const {
  return std::clamp(static_cast<int>((y - low_.y()) / size_), 0, n_rows_ - 1);
}

int SiteGrid::nearest(const Vec2& x) const {
  const int i = column(x.x()), j = row(x.y());
  int best = 0;
  // Every site nearer than `reach` squares lies in the block searched.
  for (int reach = 1;; ++reach) {
    double least = std::numeric_limits<double>::infinity();
    const int left = std::max(0, i - reach), right = std::min(n_columns_ - 1, i + reach);
    const int bottom = std::max(0, j - reach), top = std::min(n_rows_ - 1, j + reach);
    for (int r = bottom; r <= top; ++r)
      for (int k = starts_[r * n_columns_ + left]; k < starts_[r * n_columns_ + right + 1]; ++k) {
        const double distance = (sites_.col(k) - x).squaredNorm();
        if (distance < least) {
          least = distance;
          best = k;
        }
      }
    const bool all = left == 0 && bottom == 0 && right == n_columns_ - 1 && top == n_rows_ - 1;
    if (all || least <= reach * size_ * reach * size_) return indices_[best];
  }
}

}  // namespace polyfem
