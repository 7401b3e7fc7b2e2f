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

double distance_between(const PointsRef& a, const PointsRef& b) {
  if (polyfem::contains(a, b.col(0)) || polyfem::contains(b, a.col(0)) || edges_meet(a, b)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < a.cols(); ++k) nearest = std::min(nearest, distance_to_outline(a.col(k), b));
  for (Index k = 0; k < b.cols(); ++k) nearest = std::min(nearest, distance_to_outline(b.col(k), a));
  return nearest;
}

}  // namespace ddacontact::scene_format
