/// \file Gauss quadrature on an interval, plain and for functions with singularities near its ends.
#pragma once

#include <polyfem/core/types.hpp>

#include <cmath>

namespace polyfem {

/// Integral of f over (0, 1) = sum_q weights[q] f(points[q]).
struct GaussRule {
  VectorXd points, weights;
};

/// The n-point Gauss-Legendre rule, n >= 1, computed afresh: exact for degree 2n - 1.
GaussRule gauss_legendre(int n);
/// The same for n = 1 .. 64, computed once.
const GaussRule& gauss_rule(int n);

/// How far beyond the ends of (0, 1) a function stays smooth: its singularities lie at t <= -before and at
/// t >= 1 + behind, or off the real line.
struct Reach {
  double before, behind;
};

/// The variable in which a function of that reach is smooth: u = log((t + before) / (1 + behind - t)). Real
/// singularities of t go to the lines Im u = +-pi, however near the ends they are.
class GradedMap {
 public:
  explicit GradedMap(const Reach& reach)
      : length_(std::log1p(1 / reach.before) + std::log1p(1 / reach.behind)),
        range_(1 + reach.before + reach.behind),
        first_(reach.before / (1 + reach.behind)) {}
  /// The length that (0, 1) has in u.
  double length() const { return length_; }
  /// e^u at t = 0.
  double first() const { return first_; }

  /// A point t and the factor its weight gets.
  struct Image {
    double t, slope;
  };
  /// Where the point of u goes that divides the length as z divides (0, 1).
  Image operator()(double z) const {
    const double growth = std::expm1(length_ * z), e = first_ * (1 + growth), scale = range_ / (1 + e);
    return {scale * first_ * growth / (1 + first_), length_ * scale * e / (1 + e)};
  }

 private:
  double length_, range_, first_;
};

/// Gauss points in u, mapped to (0, 1): they cluster at the end whose reach is short. `rule` gets n points.
void make_graded_gauss_rule(int n, const GradedMap& map, GaussRule& rule);

/// The number of Gauss points for which a function that is analytic in an ellipse about the interval, its
/// ends the foci, is integrated to about exp(-digits): the error falls as rho^(-2 n), rho = axis +
/// sqrt(axis^2 - 1), where `axis` > 1 is the ellipse's long axis over the interval's length. 1 .. 64.
int n_gauss_points(double digits, double axis);

}  // namespace polyfem
