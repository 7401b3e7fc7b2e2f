/// \file The area that two polygons have in common.
#pragma once

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/geometry/validity.hpp>

#include <vector>

namespace support {

/// Cuts `a` by each edge of `b` in turn (Sutherland and Hodgman); both convex and counter-clockwise.
inline double overlap_area_of_convex(const polyfem::PointsRef& a, const polyfem::PointsRef& b) {
  using polyfem::Vec2;
  std::vector<Vec2> rest;
  for (polyfem::Index k = 0; k < a.cols(); ++k) rest.emplace_back(a.col(k));
  for (polyfem::Index e = 0; e < b.cols() && !rest.empty(); ++e) {
    const Vec2 from = b.col(e), along = b.col((e + 1) % b.cols()) - from;
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const Vec2 p = rest[k], q = rest[(k + 1) % rest.size()];
      const double at_p = polyfem::cross(along, p - from), at_q = polyfem::cross(along, q - from);
      if (at_p >= 0) kept.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
        kept.emplace_back(p + at_p / (at_p - at_q) * (q - p));
    }
    rest = std::move(kept);
  }
  if (rest.size() < 3) return 0;
  polyfem::Points polygon(2, rest.size());
  for (std::size_t k = 0; k < rest.size(); ++k) polygon.col(static_cast<polyfem::Index>(k)) = rest[k];
  return polyfem::signed_area(polygon);
}

/// The polygon, or the triangles of one that has a corner that is not convex.
inline std::vector<polyfem::Points> convex_parts(const polyfem::PointsRef& polygon) {
  if (!polyfem::find_non_convex_corner(polygon)) return {polygon};
  const polyfem::Triangles triangles = polyfem::triangulate(polygon);
  std::vector<polyfem::Points> parts(static_cast<std::size_t>(triangles.cols()), polyfem::Points(2, 3));
  for (polyfem::Index t = 0; t < triangles.cols(); ++t)
    for (polyfem::Index k = 0; k < 3; ++k)
      parts[static_cast<std::size_t>(t)].col(k) = polygon.col(triangles(k, t));
  return parts;
}

/// Of two simple counter-clockwise polygons.
inline double overlap_area(const polyfem::PointsRef& a, const polyfem::PointsRef& b) {
  double area = 0;
  for (const polyfem::Points& p : convex_parts(a))
    for (const polyfem::Points& q : convex_parts(b)) area += overlap_area_of_convex(p, q);
  return area;
}

}  // namespace support
