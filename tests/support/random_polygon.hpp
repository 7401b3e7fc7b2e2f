/// \file Random convex polygons and points in them, the same for the same seed.
#pragma once

#include <polyfem/core/types.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <cmath>
#include <numbers>
#include <random>

namespace support {

using polyfem::Index;
using polyfem::Points;
using polyfem::PointsRef;
using polyfem::Vec2;

inline double uniform(double from, double to, std::mt19937& random) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

inline Vec2 random_direction(std::mt19937& random) {
  const double angle = uniform(0, 2 * std::numbers::pi, random);
  return {std::cos(angle), std::sin(angle)};
}

/// The polygon with its centroid moved to the origin, scaled so that its farthest vertex is at distance 1.
inline Points centred_to_unit_size(Points polygon) {
  polygon.colwise() -= polyfem::area_moments(polygon).centroid;
  return polygon / polygon.colwise().norm().maxCoeff();
}

/// A strictly convex counter-clockwise n-gon of unit size, centred, stretched by up to 3 in some direction.
///
/// Its edges have jittered directions, each turning from the last by at least 0.3 times a regular polygon's
/// angle before the stretch, and random lengths, corrected by the least change that closes the polygon; drawn
/// again until no edge is shorter than a tenth of the typical one.
inline Points random_convex_polygon(int n, std::mt19937& random) {
  Points directions(2, n), polygon(2, n);
  polyfem::VectorXd lengths(n);
  do {
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * (k + uniform(0, 0.7, random)) / n;
      directions.col(k) << std::cos(angle), std::sin(angle);
      lengths[k] = uniform(0.3, 1, random);
    }
    const Vec2 gap = directions * lengths;
    const polyfem::Mat2 metric = directions * directions.transpose();
    const Vec2 multiplier = Vec2(metric(1, 1) * gap.x() - metric(0, 1) * gap.y(),
                                 metric(0, 0) * gap.y() - metric(1, 0) * gap.x()) /
                            (metric(0, 0) * metric(1, 1) - metric(0, 1) * metric(1, 0));
    lengths -= directions.transpose() * multiplier;
  } while (lengths.minCoeff() < 0.06);

  const Vec2 axis = random_direction(random);
  const double stretch = uniform(0, 2, random);
  Vec2 vertex = Vec2::Zero();
  for (int k = 0; k < n; ++k) {
    polygon.col(k) = vertex + stretch * axis.dot(vertex) * axis;
    vertex += lengths[k] * directions.col(k);
  }
  return centred_to_unit_size(polygon);
}

inline Points regular_polygon(int n) {
  Points polygon(2, n);
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    polygon.col(k) << std::cos(angle), std::sin(angle);
  }
  return polygon;
}

/// A point of the closed convex polygon: uniform in a random triangle of vertex 0's fan.
inline Vec2 random_point_in(const PointsRef& polygon, std::mt19937& random) {
  const Index k = std::uniform_int_distribution<Index>(1, polygon.cols() - 2)(random);
  double s = uniform(0, 1, random), t = uniform(0, 1, random);
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  return polygon.col(0) + s * (polygon.col(k) - polygon.col(0)) + t * (polygon.col(k + 1) - polygon.col(0));
}

}  // namespace support
