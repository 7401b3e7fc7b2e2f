/// \file 1, x, y, x^2, x y and y^2 in coordinates in which they are as independent on thin cells as on round
/// ones.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// A row a point, a column a monomial.
using Monomials = Eigen::Matrix<double, Eigen::Dynamic, 6>;

/// Coordinates about a centre in which a covariance is 1.
class MonomialFrame {
 public:
  MonomialFrame(const Vec2& centre, const Mat2& covariance);

  /// At points, reusing the storage.
  void evaluate(const PointsRef& points, Monomials& values) const;
  /// Their derivatives by the first or second (axis 0 or 1) of the points' own coordinates.
  void differentiate(const Monomials& values, Index axis, Monomials& slopes) const;

 private:
  Vec2 centre_;
  Mat2 scale_;  ///< lower triangle
};

}  // namespace polyfem
