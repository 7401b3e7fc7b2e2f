#include <polyfem/basis/quadratic_monomials.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <Eigen/LU>
#include <Eigen/QR>

namespace polyfem {
namespace {

/// Changes the weights by the least, relative to them, that makes the integrals of the monomials exact: in a
/// frame in which second moments over the area are those of a unit square. Points on a conic leave some
/// undetermined, which the rule has to integrate well enough itself.
void match_moments(const AreaMoments& exact, PolygonRule& rule) {
  thread_local Monomials p;
  thread_local VectorXd weighted;
  constexpr double of_unit_square = 1. / 12;
  MonomialFrame(exact.centroid, exact.second / (of_unit_square * exact.area)).evaluate(rule.points, p);
  Eigen::Matrix<double, 6, 1> missing;
  missing << 1, 0, 0, of_unit_square, 0, of_unit_square;
  missing *= exact.area;
  Eigen::Matrix<double, 6, 6> products;
  for (Index k = 0; k < 6; ++k) {
    weighted = rule.weights.cwiseProduct(p.col(k));
    missing[k] -= weighted.sum();
    for (Index l = k; l < 6; ++l) products(l, k) = products(k, l) = weighted.dot(p.col(l));
  }
  const Eigen::Matrix<double, 6, 1> change = products.colPivHouseholderQr().solve(missing);
  weighted = rule.weights;
  for (Index k = 0; k < 6; ++k) rule.weights += change[k] * p.col(k).cwiseProduct(weighted);
}

/// The integral of N_i n over the boundary: 1/6, 4/6, 1/6 of each edge's.
Vec2 quadratic_boundary_integral(const PointsRef& cell, Index i) {
  const Index n = cell.cols();
  const Vec2 chord = cell.col((i + 1) % n) - cell.col((i + n - 1) % n);  // at a corner half of two edges
  return Vec2(chord.y(), -chord.x()) * (i % 2 == 0 ? 2. / 6 : 4. / 6);
}

void correct_gradients(const PointsRef& cell, const AreaMoments& exact, TabulatedElement& element) {
  const VectorXd& w = element.rule.weights;
  thread_local VectorXd arm_x, arm_y, weighted_x, weighted_y;
  arm_x = element.rule.points.row(0).transpose().array() - exact.centroid.x();
  arm_y = element.rule.points.row(1).transpose().array() - exact.centroid.y();
  weighted_x = w.cwiseProduct(arm_x);
  weighted_y = w.cwiseProduct(arm_y);
  const Mat2 inverse_second = exact.second.inverse();
  for (Index i = 0; i < cell.cols(); ++i) {
    const Vec2 normal = quadratic_boundary_integral(cell, i);
    const Vec2 arm = cell.col(i) - exact.centroid;
    const double integral = w.dot(element.values.col(i));
    const auto correct = [&](Index axis, auto slope) {
      const double constant = (normal[axis] - w.dot(slope)) / exact.area;
      const Vec2 first = normal[axis] * arm - integral * Vec2::Unit(axis) -
                         Vec2(weighted_x.dot(slope), weighted_y.dot(slope)),
                 linear = inverse_second * first;
      slope.array() += constant + linear.x() * arm_x.array() + linear.y() * arm_y.array();
    };
    correct(0, element.dx.col(i));
    correct(1, element.dy.col(i));
  }
}

void tabulate_at_rule(const PointsRef& cell, const PointsRef& corners, const Basis& basis,
                      GradientCorrection correction, TabulatedElement& element) {
  const AreaMoments exact = area_moments(corners);
  element.area = exact.area;
  match_moments(exact, element.rule);
  evaluate_quadratic(cell, basis, element.rule.points, element);
  if (correction == GradientCorrection::on) correct_gradients(cell, exact, element);
}

}  // namespace

void tabulate_quadratic(const PointsRef& cell, const PolygonRule& rule, const Basis& basis,
                        GradientCorrection correction, TabulatedElement& element) {
  element.rule = rule;
  tabulate_at_rule(cell, quadratic_corners(cell), basis, correction, element);
}

void tabulate_quadratic(const PointsRef& cell, const TriangleRule& triangle_rule, const Basis& basis,
                        GradientCorrection correction, TabulatedElement& element) {
  const Points corners = quadratic_corners(cell);
  make_polygon_rule(corners, triangle_rule, element.rule);
  tabulate_at_rule(cell, corners, basis, correction, element);
}

}  // namespace polyfem
