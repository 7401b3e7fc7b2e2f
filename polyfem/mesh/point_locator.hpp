/// \file The cell of a mesh that contains a point, or the nearest one.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <span>
#include <vector>

namespace polyfem {

/// A point of a mesh.
struct Located {
  int cell;
  Vec2 point;       ///< of the cell's closed polygon
  double distance;  ///< from the point that was looked for; 0 inside
};

/// Finds points in a mesh. A grid with about as many squares as there are cells knows the cells near each, so
/// that a search looks at a few cells for points in the mesh or near it, however many cells there are.
///
/// `field_at(mesh, u, locator.nearest(x))` is a field and its gradient there.
class PointLocator {
 public:
  /// \param[in] mesh  kept by reference: must live longer and not change. Throws Error when it has no cells,
  /// and
  ///                  for what `require_numbering` refuses.
  explicit PointLocator(const PolygonMesh& mesh);
  explicit PointLocator(PolygonMesh&&) = delete;

  /// The cell that contains x, of several on whose edges it lies the first; or the nearest point of a cell.
  /// Throws Error unless x is finite.
  Located nearest(const Vec2& x) const;

 private:
  using Square = Eigen::Vector2i;
  Square square_of(const Vec2& x) const;
  std::span<const int> cells_in(int column, int row) const;

  const PolygonMesh* mesh_;
  Vec2 low_;
  double side_;  ///< of a square
  int n_columns_, n_rows_;
  std::vector<int> first_, cells_;  ///< those of square s begin at first_[s]; row by row
};

}  // namespace polyfem
