/// \file Horizontal cuts through a polygon: a way to visit its area evenly.
#pragma once

#include <polyfem/core/types.hpp>

#include <vector>

namespace polyfem {

/// A piece of a horizontal line inside the polygon. It stands for a strip of the rows' height around it.
struct RowPiece {
  double x_begin = 0, x_end = 0, y = 0;
};

/// All pieces of all rows.
struct DomainRows {
  std::vector<RowPiece> pieces;  ///< row by row from the bottom, each from left to right
  double height = 0;             ///< of a row
};

/// \param[in] spacing  wanted height of a row; there are at least 64 rows and at most 1e5
DomainRows domain_rows(const PointsRef& polygon, double spacing);

}  // namespace polyfem
