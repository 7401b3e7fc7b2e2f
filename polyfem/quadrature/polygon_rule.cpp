#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/quadrature/polygon_rule.hpp>

namespace polyfem {

void make_fan_rule(const PointsRef& polygon, const TriangleRule& triangle_rule, PolygonRule& rule) {
  const Index n = polygon.cols(), n_points = triangle_rule.weights.size();
  rule.points.resize(2, n * n_points);
  rule.weights.resize(n * n_points);
  const Vec2 centroid = area_moments(polygon).centroid;
  for (Index k = 0; k < n; ++k) {
    const Vec2 p = polygon.col(k) - centroid, q = polygon.col((k + 1) % n) - centroid;
    const double area = cross(p, q) / 2;
    rule.weights.segment(k * n_points, n_points) = area * triangle_rule.weights;
    for (Index i = 0; i < n_points; ++i)
      rule.points.col(k * n_points + i) =
          centroid + triangle_rule.points(1, i) * p + triangle_rule.points(2, i) * q;
  }
}

}  // namespace polyfem
