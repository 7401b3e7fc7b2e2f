#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/graded_rule.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace polyfem {
namespace {

constexpr Index most_points = 30000;
constexpr double most_digits = 42;  // beyond, round-off prevails
/// Rules to compare have so many times the points: of those nearer to each other errors may be alike.
constexpr double finer = 1.5;

/// The error of the integrals of the gradients, before a correction, over those integrals.
double gradient_defect(const PointsRef& polygon, const Basis& basis, const TabulatedElement& element) {
  thread_local ShapeTable first;
  basis.evaluate(polygon, element.rule.points.leftCols(1), first);
  double defect = 0, scale = 0;
  for (Index i = 0; i < polygon.cols(); ++i) {
    const Vec2 exact = boundary_integral(polygon, i);
    const Vec2 integral(element.dx.col(i).dot(element.rule.weights),
                        element.dy.col(i).dot(element.rule.weights));
    const Vec2 shift(element.dx(0, i) - first.dx(0, i), element.dy(0, i) - first.dy(0, i));
    defect += (exact - integral + element.area * shift).squaredNorm();
    scale += exact.squaredNorm();
  }
  return std::sqrt(defect / scale);
}

/// The largest error of the integrals of 1, x and x x^T, each over its scale.
double moment_defect(const PointsRef& polygon, const TabulatedElement& element) {
  const AreaMoments exact = area_moments(polygon);
  double area = 0;
  Vec2 first = Vec2::Zero();
  Mat2 second = Mat2::Zero();
  for (Index q = 0; q < element.n_points(); ++q) {
    const Vec2 arm = element.rule.points.col(q) - exact.centroid;
    const Vec2 weighted = element.rule.weights[q] * arm;
    area += element.rule.weights[q];
    first += weighted;
    second += weighted * arm.transpose();
  }
  return Vec3(std::abs(area / exact.area - 1), first.norm() / std::sqrt(exact.area * exact.second.trace()),
              (second - exact.second).norm() / exact.second.norm())
      .maxCoeff<Eigen::PropagateNaN>();
}

/// The corner with the largest triangle of those with an angle of 53 degrees or more, of which every polygon
/// has one. Next to short edges and straight corners also smooth functions vary fast, and in a sharp corner
/// there are few directions to differ in.
Index plainest_corner(const PointsRef& polygon) {
  const Index n = polygon.cols();
  Index plainest = 0;
  double largest = -1;
  for (Index i = 0; i < n; ++i) {
    const Vec2 a = polygon.col((i + 1) % n) - polygon.col(i),
               b = polygon.col((i + n - 1) % n) - polygon.col(i);
    if (const double size = cross(a, b); size > largest && a.dot(b) <= 0.6 * a.norm() * b.norm()) {
      largest = size;
      plainest = i;
    }
  }
  return plainest;
}

/// Whether gradients have a limit at the vertices: whether at a corner they agree in two directions from it.
/// They are compared by their parts along the edges, as in thin polygons those across hide them.
bool smooth_at_vertices(const PointsRef& polygon, const Basis& basis) {
  const Index n = polygon.cols(), corner = plainest_corner(polygon);
  Vec2 a = polygon.col((corner + 1) % n) - polygon.col(corner);
  Vec2 b = polygon.col((corner + n - 1) % n) - polygon.col(corner);
  const double step = 1e-6 * std::min(a.norm(), b.norm());
  a *= step / a.norm();
  b *= step / b.norm();
  Points trial(2, 2);
  trial.col(0) = polygon.col(corner) + (a + b) / 2;
  trial.col(1) = polygon.col(corner) + 0.95 * a + 0.05 * b;
  ShapeTable shape;
  basis.evaluate(polygon, trial, shape);
  const auto agree_along = [&](const Vec2& edge) {
    const MatrixXd slopes = edge.x() * shape.dx + edge.y() * shape.dy;
    return (slopes.row(0) - slopes.row(1)).squaredNorm() < 1e-4 * slopes.row(0).squaredNorm();
  };
  return agree_along(a) && agree_along(b);
}

double larger(const ErrorEstimate& error) {
  return Vec2(error.stiffness, error.mass).maxCoeff<Eigen::PropagateNaN>();
}

/// Rules of growing numbers of digits.
struct Ladder {
  std::string_view name;
  void (*make)(const PointsRef&, double, PolygonRule&);
  /// How fast estimates fall with the digits, and from where, on random polygons: most are met at once.
  double start, rate;

  double digits_for(double tolerance) const { return std::log(start / tolerance) / rate; }
};

const Ladder& ladder_for(const PointsRef& polygon, const Basis& basis) {
  static const Ladder smooth{"Gauss points graded by the adjoint", make_adjoint_rule, 12, 0.87};
  static const Ladder singular{"Gauss points collapsed at the vertices", make_vertex_rule, 8, 1.15};
  return !find_non_convex_corner(polygon) && smooth_at_vertices(polygon, basis) ? smooth : singular;
}

void require_fit(const PointsRef& polygon, const Basis& basis, double tolerance) {
  if (!(tolerance > 0 && tolerance < 1))
    throw Error("tabulate_to_tolerance: the tolerance must lie between 0 and 1");
  require_usable(polygon);
  require_suitable(basis, polygon);
}

double relative_difference(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).norm() / a.norm();
}

}  // namespace

ErrorEstimate estimate_errors(const PointsRef& polygon, const Basis& basis, const TabulatedElement& element) {
  const double gradients = gradient_defect(polygon, basis, element);
  const double moments = moment_defect(polygon, element);
  return {std::min(30 * gradients + 4 * moments, 100 * gradients), 30 * gradients + 8 * moments};
}

ToleranceReport tabulate_to_tolerance(const PointsRef& polygon, const Basis& basis, double tolerance,
                                      GradientCorrection correction, TabulatedElement& element) {
  require_fit(polygon, basis, tolerance);
  ToleranceReport report;
  PolygonRule rule;
  const auto meets = [&] {
    tabulate(polygon, rule, basis, correction, element);
    report.error = estimate_errors(polygon, basis, element);
    report.n_points = static_cast<int>(element.n_points());
    report.met = larger(report.error) <= tolerance;
    return report.met;
  };
  if (polygon.cols() == 3) {
    report.rule = "3 points of degree 2";
    make_ear_rule(polygon, hammer_rule(2), rule);
    if (meets()) return report;
  }
  const Ladder& ladder = ladder_for(polygon, basis);
  report.rule = ladder.name;
  double digits = ladder.digits_for(tolerance);
  double best_digits = 0, least_error = std::numeric_limits<double>::infinity();
  for (bool last = false; !last;) {
    digits = std::min(digits, most_digits);
    last = digits == most_digits;
    ladder.make(polygon, digits, rule);
    for (; rule.weights.size() > most_points; last = true) {
      digits *= 0.9;
      ladder.make(polygon, digits, rule);
    }
    if (meets()) return report;
    const double error = larger(report.error);
    if (!std::isfinite(error)) return report;  // size^4 is beyond the exponents
    if (error < least_error) {
      least_error = error;
      best_digits = digits;
    }
    digits += 0.5 + std::log(error / tolerance) / ladder.rate;
  }
  ladder.make(polygon, best_digits, rule);
  meets();
  return report;
}

ToleranceReport tabulate_quadratic_to_tolerance(const PointsRef& cell, const Basis& basis, double tolerance,
                                                GradientCorrection correction, TabulatedElement& element) {
  const Points corners = quadratic_corners(cell);
  require_fit(corners, basis, tolerance);
  ToleranceReport report;
  PolygonRule rule;
  if (corners.cols() == 3) {  // K is of degree 2, M of degree 4
    make_ear_rule(corners, dunavant_rule(4), rule);
    tabulate_quadratic(cell, rule, basis, correction, element);
    return {true, {}, static_cast<int>(element.n_points()), "6 points of degree 4"};
  }
  const Ladder& ladder = ladder_for(corners, basis);
  report.rule = ladder.name;
  MatrixXd K, M, K_before, M_before;
  for (double digits = std::min(ladder.digits_for(tolerance), most_digits);; ++digits) {
    ladder.make(corners, digits, rule);
    const auto n_points = static_cast<double>(rule.weights.size());
    if (digits > 2 * most_digits || n_points > most_points)
      return report;  // products of two corners' functions
    if (n_points < finer * report.n_points) continue;
    tabulate_quadratic(cell, rule, basis, correction, element);
    stiffness(element, elasticity_matrix(1, 0.3, Plane::strain), K);
    mass(element, M);
    if (report.n_points > 0) {
      report.error = {relative_difference(K, K_before), relative_difference(M, M_before)};
      report.met = larger(report.error) <= tolerance;
    }
    report.n_points = static_cast<int>(element.n_points());
    if (report.met) return report;
    K_before = K;
    M_before = M;
  }
}

}  // namespace polyfem
