/// \file Stabilized bi-conjugate gradients.
#pragma once

#include <ddacontact/core/types.hpp>

#include <cmath>

namespace ddacontact {

/// What an iteration found.
struct KrylovReport {
  bool converged = false;
  int iterations = 0;  ///< each with two products and two preconditionings
};

/// Solves A x = b, A unsymmetric, from x = 0, to |b - A x| <= tolerance |b| by the recurrence (van der Vorst
/// 1992).
///
/// \param[in] multiply      multiply(x, y): y = A x
/// \param[in] precondition  precondition(x, y): y = about A^-1 x
template <class Multiply, class Precondition>
KrylovReport bicgstab(const Multiply& multiply, const Precondition& precondition, const VectorXd& b,
                      double tolerance, int most_iterations, VectorXd& x) {
  KrylovReport report;
  x.setZero(b.size());
  VectorXd r = b, p = b, q, v, y, s, t;
  const VectorXd shadow = b;
  const double enough = tolerance * b.norm();
  double rho = shadow.dot(r);
  if (rho == 0) return {true, 0};
  while (report.iterations < most_iterations) {
    ++report.iterations;
    precondition(p, q);
    multiply(q, v);
    const double alpha = rho / shadow.dot(v);
    if (!std::isfinite(alpha)) return report;
    s = r - alpha * v;
    x += alpha * q;
    if (s.norm() <= enough) {
      report.converged = true;
      return report;
    }
    precondition(s, y);
    multiply(y, t);
    const double omega = t.dot(s) / t.squaredNorm();
    if (!std::isfinite(omega) || omega == 0) return report;
    x += omega * y;
    r = s - omega * t;
    if (r.norm() <= enough) {
      report.converged = true;
      return report;
    }
    const double next = shadow.dot(r), beta = next / rho * alpha / omega;
    if (!std::isfinite(beta) || next == 0) return report;
    p = r + beta * (p - omega * v);
    rho = next;
  }
  return report;
}

}  // namespace ddacontact
