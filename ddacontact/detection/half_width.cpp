#include <ddacontact/detection/half_width.hpp>

#include <ddacontact/detection/corner.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <vector>

namespace ddacontact {

using polyfem::Vec2;

double half_width(const PointsRef& polygon) {
  const int n = static_cast<int>(polygon.cols());
  double perimeter = 0;
  bool concave = false;
  std::vector<Vec2> along(n);
  for (int e = 0; e < n; ++e) {
    const Vec2 edge = polygon.col(next(e, polygon)) - polygon.col(e);
    perimeter += edge.norm();
    along[e] = edge.normalized();
    concave = concave || corner_at(polygon, e) == Corner::reflex;
  }
  double width = polyfem::signed_area(polygon) / perimeter;
  if (!concave) return width;

  constexpr double facing_away = -0.5;  // cosine between the sides
  for (int e = 0; e < n; ++e) {
    const double length = (polygon.col(next(e, polygon)) - polygon.col(e)).norm();
    for (int v = 0; v < n; ++v) {
      if (std::min(along[e].dot(along[v]), along[e].dot(along[previous(v, polygon)])) > facing_away) continue;
      if (v == e || v == next(e, polygon)) continue;
      const Vec2 from_start = polygon.col(v) - polygon.col(e);
      const double at = along[e].dot(from_start), depth = polyfem::cross(along[e], from_start);
      if (at >= 0 && at <= length && depth > 0) width = std::min(width, depth / 2);
    }
  }
  return width;
}

}  // namespace ddacontact
