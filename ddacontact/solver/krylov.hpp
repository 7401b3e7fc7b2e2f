/// \file An iteration for unsymmetric equations: least residuals.
#pragma once

#include <ddacontact/core/types.hpp>

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace ddacontact {

/// Outcome of an iteration.
struct KrylovReport {
  bool converged = false;
  int iterations = 0;
};

/// Solves A x = b, A unsymmetric, from x = 0, to |b - A x| <= tolerance |b|: each iteration has a product
/// and finds the least residual in the space of all so far (Saad and Schultz 1986).
template <class Multiply>
KrylovReport gmres(const Multiply& multiply, const VectorXd& b, double tolerance, int most_iterations,
                   VectorXd& x) {
  assert(tolerance > 0 && most_iterations > 0);
  KrylovReport report;
  x.setZero(b.size());
  const double scale = b.norm();
  if (scale == 0) return {true, 0};
  std::vector<VectorXd> basis{b / scale};
  // R x = g in the space, R by its columns: those of H turned by all rotations.
  std::vector<VectorXd> R;
  std::vector<double> g{scale}, cosine, sine;
  VectorXd w;
  while (report.iterations < most_iterations && !report.converged) {
    const std::size_t k = R.size();
    multiply(basis[k], w);
    VectorXd h = VectorXd::Zero(static_cast<Index>(k) + 2);
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t i = 0; i <= k; ++i) {
        const double along = basis[i].dot(w);
        w -= along * basis[i];
        h[i] += along;
      }
    const double left = h[k + 1] = w.norm();
    for (std::size_t i = 0; i < k; ++i) {
      double &upper = h[i], &lower = h[i + 1];
      const double before = upper;
      upper = cosine[i] * before + sine[i] * lower;
      lower = cosine[i] * lower - sine[i] * before;
    }
    const double length = std::hypot(h[k], left);
    if (!(length > 0) || !std::isfinite(length)) break;
    cosine.push_back(h[k] / length);
    sine.push_back(left / length);
    h[k] = length;
    R.push_back(std::move(h));
    g.push_back(-sine[k] * g[k]);
    g[k] *= cosine[k];
    ++report.iterations;
    report.converged = std::abs(g[k + 1]) <= tolerance * scale;
    if (left == 0) break;
    basis.push_back(w / left);
  }
  for (std::size_t i = R.size(); i-- > 0;) {
    g[i] /= R[i][i];
    for (std::size_t k = 0; k < i; ++k) g[k] -= R[i][k] * g[i];
    x += g[i] * basis[i];
  }
  return report;
}

}  // namespace ddacontact
