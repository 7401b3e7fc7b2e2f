#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {
namespace {

/// Moves a column so that its sum with the weights is `integral`.
void set_integral(const TabulatedElement& element, double integral, Eigen::Ref<VectorXd> column) {
  column.array() += (integral - column.dot(element.rule.weights)) / element.area;
}

/// N_i is linear on the two edges at vertex i, so each gives half of its length times its outward normal to
/// the integral over the boundary: half of the chord between the neighbours, turned right.
void correct_gradients(const PointsRef& polygon, TabulatedElement& element) {
  const Index n = polygon.cols();
  for (Index i = 0; i < n; ++i) {
    const Vec2 chord = polygon.col(i + 1 < n ? i + 1 : 0) - polygon.col(i > 0 ? i - 1 : n - 1);
    set_integral(element, chord.y() / 2, element.dx.col(i));
    set_integral(element, -chord.x() / 2, element.dy.col(i));
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
