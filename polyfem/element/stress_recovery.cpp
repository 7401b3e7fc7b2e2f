#include <polyfem/element/stress_recovery.hpp>

#include <Eigen/LU>

#include <cassert>

namespace polyfem {
Vec3 strain_at(const PointsRef& polygon, const Basis& basis, const Eigen::Ref<const VectorXd>& d,
               const Vec2& x) {
  assert(d.size() == 2 * polygon.cols());
  ShapeValues shape;
  basis(polygon, x, shape);
  const Mat2 G = d.reshaped(2, polygon.cols()) * shape.gradients.transpose();  // du_a / dx_b
  return {G(0, 0), G(1, 1), G(0, 1) + G(1, 0)};
}

void extrapolate_to_vertices(const PointsRef& polygon, const TabulatedElement& element,
                             const Eigen::Ref<const MatrixXd>& at_points, MatrixXd& at_vertices) {
  assert(at_points.cols() == element.n_points());
  // Weighted moments about the points' centre, where mean and slope are found apart from each other.
  const VectorXd& w = element.rule.weights;
  const Vec2 centre = element.rule.points * w / element.area;
  const Points from_centre = element.rule.points.colwise() - centre;
  const Points weighted = from_centre * w.asDiagonal();
  const Mat2 second = weighted * from_centre.transpose();
  const VectorXd mean = at_points * w / element.area;
  const Eigen::MatrixX2d slope = at_points * weighted.transpose() * second.inverse();
  at_vertices = (slope * (polygon.colwise() - centre)).colwise() + mean;
}

}  // namespace polyfem
