#include <polyfem/basis/quadratic_monomials.hpp>

#include <Eigen/Cholesky>

namespace polyfem {

MonomialFrame::MonomialFrame(const Vec2& centre, const Mat2& covariance)
    : centre_(centre), scale_(covariance.llt().matrixL().solve(Mat2::Identity())) {}

void MonomialFrame::evaluate(const PointsRef& points, Monomials& values) const {
  values.resize(points.cols(), 6);
  values.col(0).setOnes();
  for (Index q = 0; q < points.cols(); ++q) {
    const Vec2 arm = points.col(q) - centre_;
    values(q, 1) = scale_(0, 0) * arm.x();
    values(q, 2) = scale_(1, 0) * arm.x() + scale_(1, 1) * arm.y();
  }
  values.col(3) = values.col(1).cwiseAbs2();
  values.col(4) = values.col(1).cwiseProduct(values.col(2));
  values.col(5) = values.col(2).cwiseAbs2();
}

void MonomialFrame::differentiate(const Monomials& values, Index axis, Monomials& slopes) const {
  const double x = scale_(0, axis), y = scale_(1, axis);  // what the frame's x and y change by
  slopes.resize(values.rows(), 6);
  slopes.col(0).setZero();
  slopes.col(1).setConstant(x);
  slopes.col(2).setConstant(y);
  slopes.col(3) = 2 * x * values.col(1);
  slopes.col(4) = x * values.col(2) + y * values.col(1);
  slopes.col(5) = 2 * y * values.col(2);
}

}  // namespace polyfem
