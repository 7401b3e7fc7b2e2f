/// \file Random polygons of unit size with concave and straight corners, the same for the same seed.
#pragma once

#include "concave_polygons.hpp"
#include "random_polygon.hpp"
#include "random_simple_polygon.hpp"

#include <vector>

namespace support {

/// A vertex in the middle or anywhere on some edges, next to exactly.
inline Points with_straight_vertices(const Points& polygon, double probability, std::mt19937& random) {
  std::vector<Vec2> points;
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 from = polygon.col(k), to = polygon.col((k + 1) % polygon.cols());
    points.push_back(from);
    if (uniform(0, 1, random) < probability)
      points.emplace_back(from + uniform(0.2, 0.8, random) * (to - from));
  }
  Points result(2, static_cast<Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) result.col(static_cast<Index>(k)) = points[k];
  return result;
}

/// A star, or one of the named concave polygons turned and stretched, or a convex one; of unit size, centred;
/// every other one with vertices on straight edges.
inline Points random_shape(std::mt19937& random) {
  Points polygon;
  const int kind = static_cast<int>(random() % 4);
  if (kind < 2) {
    polygon = random_star(5 + static_cast<int>(random() % 8), random);
  } else if (kind == 2) {
    const std::vector<NamedPolygon> named = concave_polygons();
    polygon = named[random() % named.size()].points;
    polygon.row(0) *= uniform(0.5, 2, random);
    const Vec2 axis = random_direction(random);
    polyfem::Mat2 R;
    R << axis.x(), -axis.y(), axis.y(), axis.x();
    polygon = (R * polygon).eval();
  } else {
    polygon = random_convex_polygon(3 + static_cast<int>(random() % 6), random);
  }
  if (random() % 2) polygon = with_straight_vertices(polygon, 0.5, random);
  return centred_to_unit_size(polygon);
}

}  // namespace support
