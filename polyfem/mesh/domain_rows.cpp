#include <polyfem/mesh/domain_rows.hpp>

#include <algorithm>
#include <cmath>

namespace polyfem {

namespace {

constexpr double least_rows = 64, most_rows = 1e5;

}  // namespace

DomainRows domain_rows(const PointsRef& polygon, double spacing) {
  const double bottom = polygon.row(1).minCoeff(), top = polygon.row(1).maxCoeff();
  const int n_rows = static_cast<int>(std::clamp(std::ceil((top - bottom) / spacing), least_rows, most_rows));
  DomainRows rows;
  rows.height = (top - bottom) / n_rows;

  std::vector<std::vector<double>> crossings(n_rows);
  for (Index k = 0; k < polygon.cols(); ++k) {
    Vec2 a = polygon.col(k), b = polygon.col((k + 1) % polygon.cols());
    if (a.y() > b.y()) std::swap(a, b);
    const int first = std::max(0, static_cast<int>(std::floor((a.y() - bottom) / rows.height - 0.5)));
    for (int row = first; row < n_rows; ++row) {
      const double y = bottom + (row + 0.5) * rows.height;
      if (y >= b.y()) break;
      if (y >= a.y()) crossings[row].push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  }
  for (int row = 0; row < n_rows; ++row) {
    std::vector<double>& x = crossings[row];
    std::sort(x.begin(), x.end());
    for (std::size_t i = 0; i + 1 < x.size(); i += 2)
      rows.pieces.push_back({x[i], x[i + 1], bottom + (row + 0.5) * rows.height});
  }
  return rows;
}

}  // namespace polyfem
