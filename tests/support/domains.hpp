/// \file Polygons to divide into cells.
#pragma once

#include <polyfem/core/types.hpp>

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace support {

inline polyfem::Points polygon_of(std::initializer_list<polyfem::Vec2> vertices) {
  polyfem::Points polygon(2, static_cast<polyfem::Index>(vertices.size()));
  polyfem::Index k = 0;
  for (const polyfem::Vec2& vertex : vertices) polygon.col(k++) = vertex;
  return polygon;
}

inline polyfem::Points rectangle(double width, double height) {
  return polygon_of({{0, 0}, {width, 0}, {width, height}, {0, height}});
}

/// An L of three unit squares; its concave corner is vertex 3.
inline polyfem::Points l_shape() {
  return polygon_of({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
}

/// A star with `n_points` points and as many concave corners.
inline polyfem::Points star(int n_points) {
  polyfem::Points polygon(2, 2 * n_points);
  for (int k = 0; k < 2 * n_points; ++k) {
    const double angle = std::numbers::pi * k / n_points, radius = k % 2 == 0 ? 3 : 1.2;
    polygon.col(k) << radius * std::cos(angle), radius * std::sin(angle);
  }
  return polygon;
}

}  // namespace support
