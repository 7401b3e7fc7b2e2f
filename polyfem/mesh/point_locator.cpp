#include <polyfem/mesh/point_locator.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace polyfem {
namespace {

Vec2 nearest_on_boundary(const PointsRef& polygon, const Vec2& x) {
  Vec2 nearest = polygon.col(0);
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 start = polygon.col(k), edge = polygon.col((k + 1) % polygon.cols()) - start;
    const double along = std::clamp((x - start).dot(edge) / edge.squaredNorm(), 0., 1.);
    const Vec2 point = start + along * edge;
    if ((point - x).squaredNorm() < (nearest - x).squaredNorm()) nearest = point;
  }
  return nearest;
}

}  // namespace

PointLocator::PointLocator(const PolygonMesh& mesh) : mesh_(&mesh) {
  require_numbering(mesh);
  if (mesh.n_cells() == 0) throw Error("points are looked for in a mesh without cells: add cells first");
  const Points corners = mesh.vertices(Eigen::all, mesh.indices);
  low_ = corners.rowwise().minCoeff();
  const Vec2 size = corners.rowwise().maxCoeff() - low_;
  side_ = std::max(std::sqrt(size.prod() / mesh.n_cells()), size.maxCoeff() / mesh.n_cells());
  n_columns_ = 1 + static_cast<int>(size.x() / side_);
  n_rows_ = 1 + static_cast<int>(size.y() / side_);

  const auto for_each_square = [&](auto&& use) {
    for (int c = 0; c < mesh.n_cells(); ++c) {
      const Points polygon = mesh.outline(c);
      const Square first = square_of(polygon.rowwise().minCoeff()),
                   last = square_of(polygon.rowwise().maxCoeff());
      for (int row = first.y(); row <= last.y(); ++row)
        for (int column = first.x(); column <= last.x(); ++column) use(row * n_columns_ + column, c);
    }
  };
  first_.assign(static_cast<std::size_t>(n_columns_) * static_cast<std::size_t>(n_rows_) + 1, 0);
  for_each_square([&](int square, int) { ++first_[static_cast<std::size_t>(square) + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  cells_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for_each_square([&](int square, int c) {
    cells_[static_cast<std::size_t>(next[static_cast<std::size_t>(square)]++)] = c;
  });
}

/// The square of the point of the grid nearest to x.
PointLocator::Square PointLocator::square_of(const Vec2& x) const {
  const Vec2 position = (x - low_) / side_;
  return {static_cast<int>(std::clamp(position.x(), 0., n_columns_ - 1.)),
          static_cast<int>(std::clamp(position.y(), 0., n_rows_ - 1.))};
}

std::span<const int> PointLocator::cells_in(int column, int row) const {
  if (column < 0 || column >= n_columns_ || row < 0 || row >= n_rows_) return {};
  const auto square = static_cast<std::size_t>(row * n_columns_ + column);
  return std::span(cells_).subspan(static_cast<std::size_t>(first_[square]),
                                   static_cast<std::size_t>(first_[square + 1] - first_[square]));
}

Located PointLocator::nearest(const Vec2& x) const {
  if (!x.allFinite())
    throw Error("a point that is not finite is looked for in a mesh: give finite coordinates");
  const Square middle = square_of(x);
  Located best{-1, x, std::numeric_limits<double>::infinity()};
  const auto look_in = [&](int column, int row) {
    for (const int c : cells_in(column, row)) {
      const Points polygon = mesh_->outline(c);
      const bool is_inside = contains(polygon, x);
      const Vec2 point = is_inside ? x : nearest_on_boundary(polygon, x);
      const double distance = (point - x).norm();
      if (distance < best.distance || (distance == best.distance && c < best.cell))
        best = {c, point, distance};
    }
  };
  // Squares of ring k are at least k - 1 sides away from x.
  for (int ring = 0; ring <= std::max(n_columns_, n_rows_) && best.distance > (ring - 1) * side_; ++ring)
    for (int row = middle.y() - ring; row <= middle.y() + ring; ++row) {
      const bool is_end = std::abs(row - middle.y()) == ring;
      for (int column = middle.x() - ring; column <= middle.x() + ring;
           column += is_end || ring == 0 ? 1 : 2 * ring)
        look_in(column, row);
    }
  return best;
}

}  // namespace polyfem
