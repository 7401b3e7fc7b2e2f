/// \file Area, centroid and second moments of a polygon, in closed form.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// Integrals of 1, x and x x^T over a polygon.
struct AreaMoments {
  double area = 0;  ///< signed: > 0 for counter-clockwise vertices
  Vec2 centroid = Vec2::Zero();
  Mat2 second = Mat2::Zero();  ///< integral of (x - centroid)(x - centroid)^T
};

/// Exact for any simple polygon but for round-off, which does not grow with the distance from the origin:
/// everything is computed relative to vertex 0. Needs at least three vertices and a non-zero area.
AreaMoments area_moments(const PointsRef& polygon);

/// Signed area alone.
double signed_area(const PointsRef& polygon);

}  // namespace polyfem
