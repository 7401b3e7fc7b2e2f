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

/// Whether two boxes have a point in common.
inline bool touch(const Box& a, const Box& b) {
  return a.low.x() <= b.high.x() && b.low.x() <= a.high.x() && a.low.y() <= b.high.y() &&
         b.low.y() <= a.high.y();
}

/// The bounding box of a polygon, widened by `margin` on every side.
Box bounding_box(const PointsRef& polygon, double margin = 0);

/// Indices of two boxes, the smaller first.
using Pair = std::array<int, 2>;

/// Every pair (i < j) of boxes with a point in common, sorted.
///
/// A grid for every power of two of the boxes' extents; a box lies in the cell of its low corner, in the grid
/// of its own extent, and looks for others in that grid and in the coarser ones. O(n) for boxes that are
/// spread out, whatever their sizes. Keeps its working arrays from call to call.
class BroadPhase {
 public:
  /// Valid until the next call.
  const std::vector<Pair>& overlapping_pairs(const std::vector<Box>& boxes);
  /// Bytes of the heap.
  double memory() const;

 private:
  struct PlacedBox {
    Box box;
    int index;
  };
  /// The boxes of an extent, sorted by their cells; rows of cells stand one after the other.
  struct Grid {
    Vec2 origin;
    double extent, cell;  ///< of the largest box, and a little for round-off; of a cell
    int columns, rows;
    std::vector<int> first;  ///< of each cell, in boxes
    std::vector<PlacedBox> boxes;

    int column(double x) const;
    int row(double y) const;
  };

  void sort_into_grids(const std::vector<Box>& boxes);
  void fill(Grid& grid, const std::vector<Box>& boxes, const std::vector<int>& items);
  void find_in(const Grid& grid);
  void find_between(const Grid& finer, const Grid& coarser);
  void sort_pairs(int n_boxes);

  std::vector<std::vector<int>> items_;  ///< of each power of two
  std::vector<Grid> grids_;              ///< from fine to coarse
  std::size_t n_grids_ = 0;
  std::vector<int> cells_, first_;
  std::vector<Pair> found_, sorted_;
};

/// The same, once.
std::vector<Pair> overlapping_pairs(const std::vector<Box>& boxes);

}  // namespace ddacontact
