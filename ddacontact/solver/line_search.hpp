/// \file The exact minimum of a piecewise quadratic along a line.
#pragma once

#include <ddacontact/solver/contact_term.hpp>

#include <vector>

namespace ddacontact {

/// The potential of clipped springs and of a quadratic on the points d + t step, t >= 0. Its derivative in t
/// is continuous, piecewise linear and never falls.
class LineSearch {
 public:
  /// Forgets the springs.
  void clear();
  /// \param[in] spring  at t = 0
  /// \param[in] rate  derivative in t of the form that the spring follows
  void add(const ClippedSpring& spring, double rate);
  /// The t > 0 at which the derivative vanishes; it must be negative at 0. Where the potential falls for
  /// ever, a t beyond all changes of its springs.
  /// \param[in] slope, curvature  the derivative of the quadratic alone is slope + t curvature
  double find_minimum(double slope, double curvature);

 private:
  struct Spring {
    ClippedSpring at_start;
    double rate;
  };
  ClippedSpring at(const Spring& spring, double t) const;
  double derivative(double t) const;
  double second_derivative(double t) const;

  double slope_ = 0, curvature_ = 0;
  std::vector<Spring> springs_;
  std::vector<double> breaks_;  ///< t > 0 at which a spring begins or ceases to follow its form
};

}  // namespace ddacontact
