#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/geometry/area_moments.hpp>

namespace polyfem {
namespace {

/// Adds to a slope what makes its integral exact.
template <int N_POINTS>
[[gnu::always_inline]] inline void correct_slope(const double* weight, double exact, double per_area,
                                                 double* slope, Index any_number) {
  const Index n_points = N_POINTS == Eigen::Dynamic ? any_number : N_POINTS;
  using Two = Eigen::Array2d;
  Two sums = Two::Zero();
  Index q = 0;
  for (; q + 1 < n_points; q += 2)
    sums += Eigen::Map<const Two>(weight + q) * Eigen::Map<const Two>(slope + q);
  double sum = sums.sum();
  if (q < n_points) sum += weight[q] * slope[q];
  const double shift = per_area * (exact - sum);
  for (q = 0; q + 1 < n_points; q += 2) Eigen::Map<Two>(slope + q) += shift;
  if (q < n_points) slope[q] += shift;
}

template <int N_POINTS>
void correct_gradients(const PointsRef& polygon, TabulatedElement& element) {
  const double per_area = 1 / element.area;
  const double* const weight = element.rule.weights.data();
  const Index n_points = element.n_points(), n = polygon.cols();
  for (Index i = 0; i < n; ++i) {
    const Vec2 exact = boundary_integral(polygon, i);
    correct_slope<N_POINTS>(weight, exact.x(), per_area, element.dx.data() + i * n_points, n_points);
    correct_slope<N_POINTS>(weight, exact.y(), per_area, element.dy.data() + i * n_points, n_points);
  }
}

void tabulate_at_rule(const PointsRef& polygon, const Basis& basis, GradientCorrection correction,
                      TabulatedElement& element) {
  element.area = signed_area(polygon);
  element.rule.weights *= element.area / element.rule.weights.sum();
  basis.evaluate(polygon, element.rule.points, element);
  if (correction == GradientCorrection::off) return;
  if (element.n_points() == 4)
    correct_gradients<4>(polygon, element);
  else
    correct_gradients<Eigen::Dynamic>(polygon, element);
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
