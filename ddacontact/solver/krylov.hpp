/// \file Iterations for unsymmetric equations: stabilized bi-conjugate gradients, and least residuals.
#pragma once

#include <ddacontact/core/types.hpp>

#include <cmath>
#include <vector>

namespace ddacontact {

/// What an iteration found.
struct KrylovReport {
  bool converged = false;
  int iterations = 0;  ///< of bicgstab, each with two products and two preconditionings, or of gmres
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

/// Solves A x = b, A unsymmetric, from x = 0, to |b - A x| <= tolerance |b|: each iteration has a product
/// and finds the least residual in the space of all so far (Saad and Schultz 1986).
template <class Multiply>
KrylovReport gmres(const Multiply& multiply, const VectorXd& b, double tolerance, int most_iterations,
                   VectorXd& x) {
  KrylovReport report;
  x.setZero(b.size());
  const double scale = b.norm();
  if (scale == 0) return {true, 0};
  std::vector<VectorXd> basis{b / scale};
  // R x = g in the space: the last column of H turned by all rotations.
  MatrixXd R = MatrixXd::Zero(most_iterations, most_iterations);
  VectorXd g = VectorXd::Zero(most_iterations + 1), cosine(most_iterations), sine(most_iterations), w;
  g[0] = scale;
  while (report.iterations < most_iterations && !report.converged) {
    const int k = report.iterations++;
    multiply(basis[k], w);
    VectorXd h = VectorXd::Zero(k + 2);
    for (int twice = 0; twice < 2; ++twice)
      for (int i = 0; i <= k; ++i) {
        const double along = basis[i].dot(w);
        w -= along * basis[i];
        h[i] += along;
      }
    h[k + 1] = w.norm();
    for (int i = 0; i < k; ++i) {
      const double upper = cosine[i] * h[i] + sine[i] * h[i + 1];
      h[i + 1] = cosine[i] * h[i + 1] - sine[i] * h[i];
      h[i] = upper;
    }
    const double length = std::hypot(h[k], h[k + 1]);
    if (!(length > 0) || !std::isfinite(length)) {
      --report.iterations;
      break;
    }
    cosine[k] = h[k] / length;
    sine[k] = h[k + 1] / length;
    R.col(k).head(k) = h.head(k);
    R(k, k) = length;
    g[k + 1] = -sine[k] * g[k];
    g[k] *= cosine[k];
    report.converged = std::abs(g[k + 1]) <= tolerance * scale;
    if (h[k + 1] == 0) break;
    basis.push_back(w / h[k + 1]);
  }
  const int n = report.iterations;
  if (n == 0) return report;
  const VectorXd y = R.topLeftCorner(n, n).template triangularView<Eigen::Upper>().solve(g.head(n));
  for (int i = 0; i < n; ++i) x += y[i] * basis[i];
  return report;
}

}  // namespace ddacontact
