#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {
namespace {

/// The integral over the boundary of N_i n: N_i is linear on the two edges at vertex i, so each gives half of
/// its length times its outward normal, which is the edge turned right.
Vec2 boundary_integral(const PointsRef& polygon, Index i) {
  const Index n = polygon.cols();
  const Vec2 chord = polygon.col((i + 1) % n) - polygon.col((i + n - 1) % n);
  return Vec2(chord.y(), -chord.x()) / 2;
}

void correct_gradients(const PointsRef& polygon, TabulatedElement& element) {
  for (Index i = 0; i < polygon.cols(); ++i) {
    const Vec2 exact = boundary_integral(polygon, i);
    element.dx.row(i).array() += (exact.x() - element.dx.row(i).dot(element.rule.weights)) / element.area;
    element.dy.row(i).array() += (exact.y() - element.dy.row(i).dot(element.rule.weights)) / element.area;
  }
}

}  // namespace

void tabulate(const PointsRef& polygon, const TriangleRule& triangle_rule, Basis basis,
              GradientCorrection correction, TabulatedElement& element) {
  thread_local ShapeValues shape;
  make_fan_rule(polygon, triangle_rule, element.rule);
  element.area = element.rule.weights.sum();
  const Index n = polygon.cols(), n_points = element.rule.weights.size();
  element.values.resize(n, n_points);
  element.dx.resize(n, n_points);
  element.dy.resize(n, n_points);
  for (Index q = 0; q < n_points; ++q) {
    basis(polygon, element.rule.points.col(q), shape);
    element.values.col(q) = shape.values;
    element.dx.col(q) = shape.gradients.row(0).transpose();
    element.dy.col(q) = shape.gradients.row(1).transpose();
  }
  if (correction == GradientCorrection::on) correct_gradients(polygon, element);
}

}  // namespace polyfem
