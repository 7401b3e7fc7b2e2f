#include <polyfem/core/error.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/quadrature/gauss_rule.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <sstream>

namespace polyfem {
namespace {

double distance_to_boundary(const PointsRef& polygon, const Vec2& x) {
  double least = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 start = polygon.col(k), edge = polygon.col((k + 1) % polygon.cols()) - start;
    const double along = std::clamp((x - start).dot(edge) / edge.squaredNorm(), 0., 1.);
    least = std::min(least, (start + along * edge - x).norm());
  }
  return least;
}

void require_inside(const PointsRef& polygon, const Vec2& x) {
  constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();
  std::ostringstream message;
  message << "point load at (" << x.x() << ", " << x.y() << "): ";
  if (!x.allFinite()) throw Error(message.str() + "give a point with finite coordinates");
  if (contains(polygon, x)) return;
  const double distance = distance_to_boundary(polygon, x);
  if (distance <= round_off * polygon.cwiseAbs().maxCoeff()) return;
  message << "outside the polygon by " << distance << "; give it to the cell that contains the point";
  throw Error(message.str());
}

}  // namespace

void body_force(const TabulatedElement& element, const Vec2& b, VectorXd& f) {
  assert(f.size() == 2 * element.n_vertices());
  thread_local VectorXd integrals;
  shape_integrals(element, integrals);
  f += (b * integrals.transpose()).reshaped();
}

void body_force(const TabulatedElement& element, const VectorField& b, VectorXd& f) {
  assert(f.size() == 2 * element.n_vertices());
  for (Index q = 0; q < element.n_points(); ++q) {
    const Vec2 force = element.rule.weights[q] * b(element.rule.points.col(q));
    for (Index i = 0; i < element.n_vertices(); ++i) f.segment<2>(2 * i) += element.values(q, i) * force;
  }
}

void edge_traction(const PointsRef& polygon, Index edge, const Vec2& first, const Vec2& last, VectorXd& f) {
  const Index n = polygon.cols(), next = edge + 1 < n ? edge + 1 : 0;
  assert(0 <= edge && edge < n && f.size() == 2 * n);
  const double length = (polygon.col(next) - polygon.col(edge)).norm();
  f.segment<2>(2 * edge) += length / 6 * (2 * first + last);  // N is linear: 1 at its own end, 0 at the other
  f.segment<2>(2 * next) += length / 6 * (first + 2 * last);
}

void edge_traction(const PointsRef& polygon, Index edge, const VectorField& traction, VectorXd& f) {
  const Index n = polygon.cols(), next = edge + 1 < n ? edge + 1 : 0;
  assert(0 <= edge && edge < n && f.size() == 2 * n);
  const Vec2 start = polygon.col(edge), along = polygon.col(next) - start;
  const GaussRule& rule = gauss_rule(3);
  for (Index q = 0; q < rule.points.size(); ++q) {
    const double s = rule.points[q];
    const Vec2 force = rule.weights[q] * along.norm() * traction(start + s * along);
    f.segment<2>(2 * edge) += (1 - s) * force;
    f.segment<2>(2 * next) += s * force;
  }
}

void point_load(const PointsRef& polygon, const Basis& basis, const Vec2& x, const Vec2& force, VectorXd& f) {
  assert(f.size() == 2 * polygon.cols());
  require_inside(polygon, x);
  ShapeValues shape;
  basis(polygon, x, shape);
  for (Index i = 0; i < polygon.cols(); ++i) f.segment<2>(2 * i) += shape.values[i] * force;
}

void initial_stress(const TabulatedElement& element, const TensorsRef& stress, VectorXd& f) {
  VectorXd forces(f.size());
  stress_forces(element, stress, forces);
  f -= forces;
}

}  // namespace polyfem
