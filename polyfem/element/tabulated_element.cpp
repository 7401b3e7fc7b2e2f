#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/geometry/area_moments.hpp>

namespace polyfem {
namespace {

void correct_gradients(const PointsRef& polygon, TabulatedElement& element) {
  const double per_area = 1 / element.area;
  for (Index i = 0; i < polygon.cols(); ++i) {
    const Vec2 exact = boundary_integral(polygon, i);
    auto dx = element.dx.col(i), dy = element.dy.col(i);
    dx.array() += per_area * (exact.x() - dx.dot(element.rule.weights));
    dy.array() += per_area * (exact.y() - dy.dot(element.rule.weights));
  }
}

void tabulate_at_rule(const PointsRef& polygon, const Basis& basis, GradientCorrection correction,
                      TabulatedElement& element) {
  element.area = signed_area(polygon);
  element.rule.weights *= element.area / element.rule.weights.sum();
  basis.evaluate(polygon, element.rule.points, element);
  if (correction == GradientCorrection::on) correct_gradients(polygon, element);
}

}  // namespace

Vec2 boundary_integral(const PointsRef& polygon, Index i) {
  const Index n = polygon.cols();
  const Vec2 chord = polygon.col(i + 1 < n ? i + 1 : 0) - polygon.col(i > 0 ? i - 1 : n - 1);
  return Vec2(chord.y(), -chord.x()) / 2;
}

void tabulate(const PointsRef& polygon, const PolygonRule& rule, const Basis& basis,
              GradientCorrection correction, TabulatedElement& element) {
  element.rule = rule;
  tabulate_at_rule(polygon, basis, correction, element);
}

void tabulate(const PointsRef& polygon, const TriangleRule& triangle_rule, const Basis& basis,
              GradientCorrection correction, TabulatedElement& element) {
  make_polygon_rule(polygon, triangle_rule, element.rule);
  tabulate_at_rule(polygon, basis, correction, element);
}

}  // namespace polyfem
