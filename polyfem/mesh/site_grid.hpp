/// \file Finds the nearest of many points.
#pragma once

#include <polyfem/core/types.hpp>

#include <vector>

namespace polyfem {

/// Points sorted into the squares of a grid.
class SiteGrid {
 public:
  /// \param[in] low, high  corners of a box that holds all sites and all points asked about
  SiteGrid(const Points& sites, const Vec2& low, const Vec2& high);

  /// Index of the site nearest to x; of several the one that comes first in the grid.
  int nearest(const Vec2& x) const;

 private:
  int column(double x) const;
  int row(double y) const;

  Vec2 low_;
  double size_;
  int n_columns_, n_rows_;
  std::vector<int> starts_;   ///< of each square's sites, row by row from the bottom
  std::vector<int> indices_;  ///< sites in that order
  Points sites_;              ///< in that order
};

}  // namespace polyfem
