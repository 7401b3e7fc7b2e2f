#include <ddacontact/detection/half_width.hpp>

#include <ddacontact/detection/corner.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cassert>

namespace ddacontact {

double half_width(const PointsRef& polygon) {
  const int n = static_cast<int>(polygon.cols());
  assert(n >= 3);
  double perimeter = 0;
  bool concave = false;
  for (int e = 0; e < n; ++e) {
    perimeter += along(polygon, e).norm();
    concave = concave || corner_at(polygon, e) == Corner::reflex;
  }
  double width = polyfem::signed_area(polygon) / perimeter;
  if (!concave) return width;

  constexpr double facing_away = -0.5;  // cosine between the sides
  for (int e = 0; e < n; ++e) {
    const Vec2 t = along(polygon, e).normalized();
    const auto faces_away = [&](int side) { return t.dot(along(polygon, side).normalized()) <= facing_away; };
    for (int v = 0; v < n; ++v) {
      if (v == e || v == next(e, polygon) || !(faces_away(v) || faces_away(previous(v, polygon)))) continue;
      const Vec2 from_start = polygon.col(v) - polygon.col(e);
      const double at = t.dot(from_start), depth = cross(t, from_start);
      if (at >= 0 && at <= along(polygon, e).norm() && depth > 0) width = std::min(width, depth / 2);
    }
  }
  return width;
}

}  // namespace ddacontact
