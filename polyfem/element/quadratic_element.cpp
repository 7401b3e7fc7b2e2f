#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>

namespace polyfem {
namespace {

/// Changes the weights by the least, relative to them, that makes the integrals of 1, x, y, x^2, x y and y^2
/// exact.
void match_moments(const AreaMoments& exact, PolygonRule& rule) {
  const double size = std::sqrt(exact.area);
  Eigen::Matrix<double, 6, Eigen::Dynamic> p(6, rule.weights.size());
  for (Index q = 0; q < p.cols(); ++q) {
    const Vec2 x = (rule.points.col(q) - exact.centroid) / size;
    p.col(q) << 1, x.x(), x.y(), x.x() * x.x(), x.x() * x.y(), x.y() * x.y();
  }
  const Mat2 second = exact.second / exact.area;
  Eigen::Matrix<double, 6, 1> moments;
  moments << exact.area, 0, 0, second(0, 0), second(0, 1), second(1, 1);
  const Eigen::Matrix<double, 6, Eigen::Dynamic> weighted = p * rule.weights.asDiagonal();
  const Eigen::Matrix<double, 6, 6> products = weighted * p.transpose();
  const Eigen::Matrix<double, 6, 1> change = products.colPivHouseholderQr().solve(moments - p * rule.weights);
  rule.weights.array() *= 1 + (p.transpose() * change).array();
}

/// The integral of N_i n over the boundary: 1/6, 4/6, 1/6 of each edge's.
Vec2 quadratic_boundary_integral(const PointsRef& cell, Index i) {
  const Index n = cell.cols();
  const Vec2 chord = cell.col((i + 1) % n) - cell.col((i + n - 1) % n);  // at a corner half of two edges
  return Vec2(chord.y(), -chord.x()) * (i % 2 == 0 ? 2. / 6 : 4. / 6);
}

void correct_gradients(const PointsRef& cell, const AreaMoments& exact, TabulatedElement& element) {
  const VectorXd& w = element.rule.weights;
  const Points arms = element.rule.points.colwise() - exact.centroid;
  const Points weighted = arms * w.asDiagonal();
  const Mat2 inverse_second = exact.second.inverse();
  for (Index i = 0; i < cell.cols(); ++i) {
    const Vec2 normal = quadratic_boundary_integral(cell, i);
    const Vec2 arm = cell.col(i) - exact.centroid;
    const double integral = w.dot(element.values.col(i));
    const auto correct = [&](Index axis, auto slope) {
      const double constant = (normal[axis] - w.dot(slope)) / exact.area;
      const Vec2 first = normal[axis] * arm - integral * Vec2::Unit(axis) - weighted * slope;
      slope.array() += constant;
      slope += arms.transpose() * (inverse_second * first);
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
