/// \file Single cells of second order.
#pragma once

#include <polyfem/core/types.hpp>

namespace support {

/// The polygon's corners and the middles of its edges in turn.
inline polyfem::Points with_middles(const polyfem::PointsRef& polygon) {
  const polyfem::Index n = polygon.cols();
  polyfem::Points cell(2, 2 * n);
  for (polyfem::Index k = 0; k < n; ++k) {
    cell.col(2 * k) = polygon.col(k);
    cell.col(2 * k + 1) = (polygon.col(k) + polygon.col((k + 1) % n)) / 2;
  }
  return cell;
}

}  // namespace support
