#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {
namespace {

/// N_i is linear on the two edges at vertex i, so each gives half of its length times its outward normal to
/// the integral over the boundary: half of the chord between the neighbours, turned right.
void correct_gradients(const PointsRef& polygon, TabulatedElement& element) {
  const Index n = polygon.cols();
  const double per_area = 1 / element.area;
  for (Index i = 0; i < n; ++i) {
    const Vec2 chord = polygon.col(i + 1 < n ? i + 1 : 0) - polygon.col(i > 0 ? i - 1 : n - 1);
    auto dx = element.dx.col(i), dy = element.dy.col(i);
    dx.array() += per_area * (chord.y() / 2 - dx.dot(element.rule.weights));
    dy.array() += per_area * (-chord.x() / 2 - dy.dot(element.rule.weights));
  }
}

void tabulate_at_rule(const PointsRef& polygon, const Basis& basis, GradientCorrection correction,
                      TabulatedElement& element) {
  element.area = element.rule.weights.sum();
  basis.evaluate(polygon, element.rule.points, element);
  if (correction == GradientCorrection::on) correct_gradients(polygon, element);
}

}  // namespace

void tabulate(const PointsRef& polygon, const PolygonRule& rule, const Basis& basis,
              GradientCorrection correction, TabulatedElement& element) {
  element.rule = rule;
  tabulate_at_rule(polygon, basis, correction, element);
}

void tabulate(const PointsRef& polygon, const TriangleRule& triangle_rule, const Basis& basis,
              GradientCorrection correction, TabulatedElement& element) {
  make_fan_rule(polygon, triangle_rule, element.rule);
  tabulate_at_rule(polygon, basis, correction, element);
}

}  // namespace polyfem
