#include <polyfem/element/stress_recovery.hpp>

#include <Eigen/Eigenvalues>

#include <cassert>

namespace polyfem {
namespace {

/// The inverse of a symmetric matrix, zero in the directions of eigenvalues that are not above `least`.
Mat2 inverse_above(double least, const Mat2& A) {
  const Eigen::SelfAdjointEigenSolver<Mat2> eigen(A);
  const Vec2 inverses = (eigen.eigenvalues().array() > least).select(eigen.eigenvalues().cwiseInverse(), 0);
  return eigen.eigenvectors() * inverses.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

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
  // Weighted moments about the points' centre, where mean and slope are found apart from each other. All
  // positions are seen from vertex 0: the digits of a far origin are taken off first, by exact differences.
  const VectorXd& w = element.rule.weights;
  const Points points = element.rule.points.colwise() - polygon.col(0);
  const Vec2 centre = points * w / element.area;
  const Points from_centre = points.colwise() - centre;
  const Points weighted = from_centre * w.asDiagonal();
  const Mat2 second = weighted * from_centre.transpose();
  const VectorXd mean = at_points * w / element.area;
  const Points arms = (polygon.colwise() - polygon.col(0)).colwise() - centre;
  const double negligible = 1e-14 * element.area * arms.colwise().squaredNorm().maxCoeff();
  const Eigen::MatrixX2d slope = at_points * weighted.transpose() * inverse_above(negligible, second);
  at_vertices = (slope * arms).colwise() + mean;
}

}  // namespace polyfem
