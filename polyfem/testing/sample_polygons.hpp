/// \file Polygons to try a basis on, the same on every machine.
#pragma once

#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace polyfem {

/// Which polygons there are to be among the samples.
enum class SampleShapes {
  strictly_convex,  ///< every corner turns left
  convex,           ///< vertices on edges as well
  simple            ///< concave polygons as well
};

/// A counter-clockwise polygon of about unit size. Its coordinates are multiples of 2^-23, so it can be moved
/// by whole numbers up to 1e8, halved and turned without round-off.
struct SamplePolygon {
  std::string name;
  Points vertices;
};

/// Random numbers that no standard library is free to choose.
class SampleRandom {
 public:
  explicit SampleRandom(int seed) : random_(static_cast<unsigned>(seed)) {}
  /// In [low, high).
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 0x1p32;
  }

 private:
  std::mt19937 random_;
};

/// The nearest multiples of 2^-bits.
inline Points on_grid(const Points& points, int bits = 22) {
  return (std::ldexp(1., bits) * points).array().round().matrix() / std::ldexp(1., bits);
}

/// A strictly convex n-gon: vertices at uneven places of an ellipse.
inline Points convex_sample(int n, SampleRandom& random) {
  const double axis = random(0, 2 * std::numbers::pi), width = random(0.4, 1);
  Points polygon(2, n);
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + random(0, 0.7)) / n;
    polygon.col(k) << std::cos(angle), width * std::sin(angle);
  }
  Mat2 rotation;
  rotation << std::cos(axis), -std::sin(axis), std::sin(axis), std::cos(axis);
  return on_grid(rotation * polygon);
}

/// An n-gon of random radii about the origin; concave but for very small n.
inline Points star_sample(int n, SampleRandom& random) {
  Points polygon(2, n);
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * (k + random(0, 0.7)) / n;
    polygon.col(k) = random(0.3, 1) * Vec2(std::cos(angle), std::sin(angle));
  }
  return on_grid(polygon);
}

/// The polygon with a vertex more in the middle of every edge.
inline Points with_middle_vertices(const Points& polygon) {
  Points result(2, 2 * polygon.cols());
  for (Index k = 0; k < polygon.cols(); ++k) {
    result.col(2 * k) = polygon.col(k);
    result.col(2 * k + 1) = (polygon.col(k) + polygon.col((k + 1) % polygon.cols())) / 2;
  }
  return result;
}

/// Polygons that Wachspress functions are not for.
inline std::vector<SamplePolygon> concave_samples() {
  Points dart(2, 4), l_shape(2, 6), notch(2, 7);
  dart << 0, 1, 0, 0.25,  //
      0, 0, 1, 0.25;
  l_shape << 0, 1, 1, 0.5, 0.5, 0,  //
      0, 0, 0.5, 0.5, 1, 1;
  notch << 0, 1, 1, 0.5625, 0.5, 0.4375, 0,  //
      0, 0, 1, 1, 0.125, 1, 1;
  return {{"dart", dart}, {"L", l_shape}, {"square with a deep notch", notch}};
}

/// Polygons of up to `largest_n` vertices.
inline std::vector<SamplePolygon> sample_polygons(SampleShapes shapes, int largest_n) {
  std::vector<SamplePolygon> samples;
  const auto add = [&](const std::string& name, const Points& vertices) {
    const std::string n = std::to_string(vertices.cols());
    if (vertices.cols() <= largest_n) samples.push_back({name + " with " + n + " vertices", vertices});
  };
  Points square(2, 4);
  square << 0, 1, 1, 0,  //
      0, 0, 1, 1;
  add("unit square", square);
  for (const int n : {3, 4, 5, 6, 7, 8, 12, 20, 50, 100})
    for (int trial = 0; trial < 2; ++trial) {
      SampleRandom random(2 * n + trial);
      add("convex polygon", convex_sample(n, random));
      if (shapes != SampleShapes::strictly_convex)
        add("convex polygon, every other vertex on an edge,", with_middle_vertices(convex_sample(n, random)));
      if (shapes == SampleShapes::simple) add("star", star_sample(std::max(n, 5), random));
    }
  if (shapes == SampleShapes::simple)
    for (const SamplePolygon& sample : concave_samples()) add(sample.name, sample.vertices);
  return samples;
}

/// The distance from x to the nearest edge.
inline double distance_to_boundary(const Points& polygon, const Vec2& x) {
  double distance = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 a = polygon.col(k), edge = polygon.col((k + 1) % polygon.cols()) - a;
    const double s = std::clamp((x - a).dot(edge) / edge.squaredNorm(), 0., 1.);
    distance = std::min(distance, (x - a - s * edge).norm());
  }
  return distance;
}

/// Points inside, multiples of 2^-25, the first ones not close to the boundary.
inline Points inner_points(const Points& polygon, int n_points) {
  SampleRandom random(static_cast<int>(polygon.cols()));
  const Vec2 low = polygon.rowwise().minCoeff(), high = polygon.rowwise().maxCoeff();
  double margin = 0.2 * (high - low).minCoeff();
  Points points(2, n_points);
  for (int found = 0; found < n_points; margin *= 0.98) {
    const Points x = on_grid(Vec2(random(low.x(), high.x()), random(low.y(), high.y())), 25);
    if (contains(polygon, x) && distance_to_boundary(polygon, x) > margin) points.col(found++) = x;
  }
  return points;
}

/// Points on edges, multiples of 2^-25: exactly on them.
inline Points edge_points(const Points& polygon, Index edge) {
  const Vec2 a = polygon.col(edge), b = polygon.col((edge + 1) % polygon.cols());
  Points points(2, 3);
  points << (3 * a + b) / 4, (a + b) / 2, (a + 3 * b) / 4;
  return points;
}

}  // namespace polyfem
