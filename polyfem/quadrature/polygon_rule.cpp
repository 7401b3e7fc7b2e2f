#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/quadrature/gauss_rule.hpp>
#include <polyfem/quadrature/polygon_rule.hpp>

#include <cassert>

namespace polyfem {
namespace {

/// The triangle rule on triangle k of `n`, with corners a, b, c.
void place(const Vec2& a, const Vec2& b, const Vec2& c, const TriangleRule& triangle_rule, Index k,
           PolygonRule& rule) {
  const Index n_points = triangle_rule.weights.size();
  const Vec2 p = b - a, q = c - a;
  const double area = cross(p, q) / 2;
  rule.weights.segment(k * n_points, n_points) = area * triangle_rule.weights;
  for (Index i = 0; i < n_points; ++i)
    rule.points.col(k * n_points + i) = a + triangle_rule.points(1, i) * p + triangle_rule.points(2, i) * q;
}

void resize(Index n_triangles, const TriangleRule& triangle_rule, PolygonRule& rule) {
  rule.points.resize(2, n_triangles * triangle_rule.weights.size());
  rule.weights.resize(n_triangles * triangle_rule.weights.size());
}

void make_fan_rule(const PointsRef& polygon, const Vec2& centroid, const TriangleRule& triangle_rule,
                   PolygonRule& rule) {
  const Index n = polygon.cols();
  resize(n, triangle_rule, rule);
  for (Index k = 0; k < n; ++k)
    place(centroid, polygon.col(k), polygon.col((k + 1) % n), triangle_rule, k, rule);
}

}  // namespace

bool is_star_shaped(const PointsRef& polygon, const Vec2& centre) {
  const Index n = polygon.cols();
  for (Index k = 0; k < n; ++k)
    if (!(cross(polygon.col(k) - centre, polygon.col((k + 1) % n) - centre) > 0)) return false;
  return true;
}

void make_fan_rule(const PointsRef& polygon, const TriangleRule& triangle_rule, PolygonRule& rule) {
  make_fan_rule(polygon, area_moments(polygon).centroid, triangle_rule, rule);
}

void make_ear_rule(const PointsRef& polygon, const TriangleRule& triangle_rule, PolygonRule& rule) {
  make_ear_rule(polygon, triangulate(polygon), triangle_rule, rule);
}

void make_ear_rule(const PointsRef& polygon, const Triangles& ears, const TriangleRule& triangle_rule,
                   PolygonRule& rule) {
  resize(ears.cols(), triangle_rule, rule);
  for (Index k = 0; k < ears.cols(); ++k)
    place(polygon.col(ears(0, k)), polygon.col(ears(1, k)), polygon.col(ears(2, k)), triangle_rule, k, rule);
}

void make_polygon_rule(const PointsRef& polygon, const TriangleRule& triangle_rule, PolygonRule& rule) {
  const Vec2 centroid = area_moments(polygon).centroid;
  if (is_star_shaped(polygon, centroid))
    make_fan_rule(polygon, centroid, triangle_rule, rule);
  else
    make_ear_rule(polygon, triangle_rule, rule);
}

void make_quadrilateral_rule(const PointsRef& quadrilateral, const GaussRule& along_0,
                             const GaussRule& along_1, PolygonRule& rule) {
  assert(quadrilateral.cols() == 4);
  const Index n_0 = along_0.points.size(), n_1 = along_1.points.size();
  rule.points.resize(2, n_0 * n_1);
  rule.weights.resize(n_0 * n_1);
  const Vec2 bottom = quadrilateral.col(1) - quadrilateral.col(0);
  const Vec2 top = quadrilateral.col(2) - quadrilateral.col(3);
  for (Index i = 0, q = 0; i < n_0; ++i) {
    const double s = along_0.points[i];
    const Vec2 from = quadrilateral.col(0) + s * bottom, line = quadrilateral.col(3) + s * top - from;
    for (Index j = 0; j < n_1; ++j, ++q) {
      const double t = along_1.points[j];
      rule.points.col(q) = from + t * line;
      rule.weights[q] = along_0.weights[i] * along_1.weights[j] * cross((1 - t) * bottom + t * top, line);
    }
  }
}

void make_quadrilateral_rule(const PointsRef& quadrilateral, int n_gauss, PolygonRule& rule) {
  make_quadrilateral_rule(quadrilateral, gauss_rule(n_gauss), gauss_rule(n_gauss), rule);
}

}  // namespace polyfem
