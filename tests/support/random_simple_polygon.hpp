/// \file Random simple polygons, most of them concave, the same for the same seed.
#pragma once

#include "random_polygon.hpp"

#include <polyfem/geometry/validity.hpp>

namespace support {

/// Seen from the origin its vertices lie one after the other, at random distances.
inline Points random_star(int n, std::mt19937& random) {
  Points star(2, n);
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + uniform(0, 0.8, random)) / n;
    star.col(k) = uniform(0.15, 1, random) * Vec2(std::cos(angle), std::sin(angle));
  }
  return star;
}

/// With one more vertex behind vertex `at`.
inline Points with_vertex(const Points& polygon, Index at, const Vec2& vertex) {
  Points result(2, polygon.cols() + 1);
  result.leftCols(at + 1) = polygon.leftCols(at + 1);
  result.col(at + 1) = vertex;
  result.rightCols(polygon.cols() - at - 1) = polygon.rightCols(polygon.cols() - at - 1);
  return result;
}

/// A simple polygon grown from a triangle by vertices put in at random where it stays simple.
inline Points random_simple_polygon(int n, std::mt19937& random) {
  Points polygon(2, 3);
  polygon << 0, 1, 0.4, 0, 0, 0.9;
  while (polygon.cols() < n) {
    const Index at = std::uniform_int_distribution<Index>(0, polygon.cols() - 1)(random);
    const double x = uniform(-1, 2, random), y = uniform(-1, 2, random);
    const Points grown = with_vertex(polygon, at, Vec2(x, y));
    if (!polyfem::find_defect(grown) && polyfem::signed_area(grown) > 0.1) polygon = grown;
  }
  return polygon;
}

}  // namespace support
