#include <polyfem/core/error.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/quadrature/graded_rule.hpp>

#include <algorithm>
#include <cmath>

namespace polyfem {
namespace {

constexpr Index most_points = 30000;
constexpr double most_digits = 42;  // beyond, round-off prevails

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
  return std::max({std::abs(area / exact.area - 1),
                   first.norm() / std::sqrt(exact.area * exact.second.trace()),
                   (second - exact.second).norm() / exact.second.norm()});
}

/// Whether the gradients at the sharpest corner of a polygon have a limit.
bool smooth_at_vertices(const PointsRef& polygon, const Basis& basis) {
  const Index n = polygon.cols();
  Index corner = 0;
  double sharpest = -2;  // the cosine of the angle between the edges
  for (Index i = 0; i < n; ++i) {
    const Vec2 a = polygon.col((i + 1) % n) - polygon.col(i),
               b = polygon.col((i + n - 1) % n) - polygon.col(i);
    if (const double cosine = a.dot(b) / (a.norm() * b.norm()); cosine > sharpest) {
      sharpest = cosine;
      corner = i;
    }
  }
  Vec2 a = polygon.col((corner + 1) % n) - polygon.col(corner);
  Vec2 b = polygon.col((corner + n - 1) % n) - polygon.col(corner);
  const double step = 1e-5 * std::min(a.norm(), b.norm());
  a *= step / a.norm();
  b *= step / b.norm();
  Points trial(2, 2);
  trial.col(0) = polygon.col(corner) + (a + b) / 2;
  trial.col(1) = polygon.col(corner) + 0.95 * a + 0.05 * b;
  ShapeTable shape;
  basis.evaluate(polygon, trial, shape);
  const auto jump = [](const MatrixXd& d) { return (d.row(0) - d.row(1)).squaredNorm(); };
  return jump(shape.dx) + jump(shape.dy) <
         1e-4 * (shape.dx.row(0).squaredNorm() + shape.dy.row(0).squaredNorm());
}

}  // namespace

ErrorEstimate estimate_errors(const PointsRef& polygon, const Basis& basis, const TabulatedElement& element) {
  const double gradients = gradient_defect(polygon, basis, element);
  const double moments = moment_defect(polygon, element);
  return {std::min(30 * gradients + 4 * moments, 100 * gradients), 30 * gradients + 8 * moments};
}

ToleranceReport tabulate_to_tolerance(const PointsRef& polygon, const Basis& basis, double tolerance,
                                      GradientCorrection correction, TabulatedElement& element) {
  if (!(tolerance > 0 && tolerance < 1))
    throw Error("tabulate_to_tolerance: the tolerance must lie between 0 and 1");
  require_suitable(basis, polygon);

  ToleranceReport report;
  const auto meets = [&] {
    report.error = estimate_errors(polygon, basis, element);
    report.n_points = static_cast<int>(element.n_points());
    report.met = std::max(report.error.stiffness, report.error.mass) <= tolerance;
    return report.met;
  };
  PolygonRule rule;
  if (polygon.cols() == 3) {
    report.rule = "3 points of degree 2";
    make_ear_rule(polygon, hammer_rule(2), rule);
    tabulate(polygon, rule, basis, correction, element);
    if (meets()) return report;
  }
  // How fast estimates fall with the digits, and from where, on random polygons: most are met at once.
  struct Ladder {
    std::string_view name;
    void (*make)(const PointsRef&, double, PolygonRule&);
    double start, rate;
  };
  const Ladder smooth{"Gauss points graded by the adjoint", make_adjoint_rule, 12, 0.87};
  const Ladder singular{"Gauss points collapsed at the vertices", make_vertex_rule, 8, 1.15};
  const Ladder& ladder =
      !find_non_convex_corner(polygon) && smooth_at_vertices(polygon, basis) ? smooth : singular;
  report.rule = ladder.name;
  double digits = std::log(ladder.start / tolerance) / ladder.rate;
  for (bool last = false; !last;) {
    digits = std::min(digits, most_digits);
    last = digits == most_digits;
    ladder.make(polygon, digits, rule);
    for (; rule.weights.size() > most_points; last = true) {
      digits *= 0.9;
      ladder.make(polygon, digits, rule);
    }
    tabulate(polygon, rule, basis, correction, element);
    if (meets()) break;
    digits += 0.5 + std::log(std::max(report.error.stiffness, report.error.mass) / tolerance) / ladder.rate;
  }
  return report;
}

}  // namespace polyfem
