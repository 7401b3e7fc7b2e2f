#include <polyfem/geometry/area_moments.hpp>

#include <cassert>

namespace polyfem {

// The polygon is the signed sum of the triangles (v_0, v_k, v_k+1). With p, q the last two corners seen from
// v_0 and c = cross(p, q), such a triangle has
//     area c/2,   first moment c/6 (p + q),   second moment c/24 (p p^T + q q^T + (p + q)(p + q)^T).
AreaMoments area_moments(const PointsRef& polygon) {
  assert(polygon.cols() >= 3);
  double twice_area = 0;
  Vec2 first = Vec2::Zero();
  Mat2 second = Mat2::Zero();
  for (Index k = 1; k + 1 < polygon.cols(); ++k) {
    const Vec2 p = polygon.col(k) - polygon.col(0);
    const Vec2 q = polygon.col(k + 1) - polygon.col(0);
    const Vec2 sum = p + q;
    const double c = cross(p, q);
    twice_area += c;
    first += c / 6 * sum;
    second += c / 24 * (p * p.transpose() + q * q.transpose() + sum * sum.transpose());
  }
  AreaMoments moments;
  moments.area = twice_area / 2;
  const Vec2 arm = first / moments.area;
  moments.centroid = polygon.col(0) + arm;
  moments.second = second - moments.area * arm * arm.transpose();
  return moments;
}

double signed_area(const PointsRef& polygon) {
  assert(polygon.cols() >= 3);
  double twice_area = 0;
  for (Index k = 1; k + 1 < polygon.cols(); ++k)
    twice_area += cross(polygon.col(k) - polygon.col(0), polygon.col(k + 1) - polygon.col(0));
  return twice_area / 2;
}

}  // namespace polyfem
