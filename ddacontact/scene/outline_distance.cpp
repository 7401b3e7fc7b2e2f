#include <ddacontact/scene/outline_distance.hpp>

#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <limits>

namespace ddacontact::scene_format {

namespace {

bool edges_meet(const PointsRef& a, const PointsRef& b) {
  for (Index i = 0; i < a.cols(); ++i)
    for (Index j = 0; j < b.cols(); ++j)
      if (polyfem::segments_intersect(a.col(i), a.col((i + 1) % a.cols()), b.col(j),
                                      b.col((j + 1) % b.cols())))
        return true;
  return false;
}

}  // namespace

double distance_to_edge(const Vec2& point, const Vec2& start, const Vec2& end) {
  const Vec2 edge = end - start;
  const double square = edge.squaredNorm(),
               along = square > 0 ? std::clamp(edge.dot(point - start) / square, 0.0, 1.0) : 0;
  return (start + along * edge - point).norm();
}

double distance_to_outline(const Vec2& point, const PointsRef& polygon) {
  double nearest = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < polygon.cols(); ++k)
    nearest =
        std::min(nearest, distance_to_edge(point, polygon.col(k), polygon.col((k + 1) % polygon.cols())));
  return nearest;
}

double distance_between(const PointsRef& a, const PointsRef& b) {
  if (polyfem::contains(a, b.col(0)) || polyfem::contains(b, a.col(0)) || edges_meet(a, b)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < a.cols(); ++k) nearest = std::min(nearest, distance_to_outline(a.col(k), b));
  for (Index k = 0; k < b.cols(); ++k) nearest = std::min(nearest, distance_to_outline(b.col(k), a));
  return nearest;
}

}  // namespace ddacontact::scene_format
