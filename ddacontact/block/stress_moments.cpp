#include <ddacontact/block/stress_moments.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace ddacontact {

namespace {

/// Displacements with the strain xx, yy or xy equal to x (column 0) or y (column 1), all others zero.
Vec2 displacement(int strain, int axis, const Vec2& x) {
  const double xx = x.x() * x.x() / 2, yy = x.y() * x.y() / 2, xy = x.x() * x.y();
  if (strain == 0) return axis == 0 ? Vec2(xx, 0) : Vec2(xy, -xx);
  if (strain == 1) return axis == 0 ? Vec2(-yy, xy) : Vec2(0, yy);
  return axis == 0 ? Vec2(0, xx) : Vec2(yy, 0);
}

/// Integral of x x^T.
Mat2 second_moments(const polyfem::PolygonRule& rule) {
  return rule.points * rule.weights.asDiagonal() * rule.points.transpose();
}

}  // namespace

StressMoments moments_of_forces(const polyfem::PolygonRule& rule, std::span<const ActingForce> forces,
                                const Vec2& body) {
  const double area = rule.weights.sum();
  Vec2 sum = area * body;
  double moment = 0;
  for (const ActingForce& acting : forces) {
    sum += acting.force;
    moment += cross(acting.point, acting.force);
  }
  const double spin = moment / second_moments(rule).trace();
  StressMoments moments;
  for (int strain = 0; strain < moments.rows(); ++strain)
    for (int axis = 0; axis < 2; ++axis) {
      double work = 0;
      for (const ActingForce& acting : forces)
        work += acting.force.dot(displacement(strain, axis, acting.point));
      for (Index q = 0; q < rule.weights.size(); ++q) {
        const Vec2 x = rule.points.col(q);
        const Vec2 left_over = body - sum / area - spin * Vec2(-x.y(), x.x());
        work += rule.weights[q] * left_over.dot(displacement(strain, axis, x));
      }
      moments(strain, axis) = work;
    }
  return moments;
}

StressMoments moments_of_stresses(const polyfem::PolygonRule& rule, const TensorsRef& stress) {
  return stress * rule.weights.asDiagonal() * rule.points.transpose();
}

double energy_of_moments(const polyfem::PolygonRule& rule, const Mat3& compliance,
                         const StressMoments& moments) {
  // sigma = a x, a J = moments
  const StressMoments a = moments * second_moments(rule).inverse();
  return (a.transpose() * compliance * moments).trace() / 2;
}

double energy_of_bending(const polyfem::PolygonRule& rule, const Mat3& compliance,
                         const StressMoments& moments) {
  const Eigen::SelfAdjointEigenSolver<Mat2> axes(second_moments(rule));  // across first
  const Vec2 across = axes.eigenvectors().col(0), along = axes.eigenvectors().col(1);
  const Vec3 of_axial(along.x() * along.x(), along.y() * along.y(), 2 * along.x() * along.y());
  const double moment = of_axial.dot(moments * across);
  return compliance(0, 0) * moment * moment / axes.eigenvalues()[0] / 2;
}

}  // namespace ddacontact
