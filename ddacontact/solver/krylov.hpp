/// \file Iterations for unsymmetric equations: stabilized bi-conjugate gradients, and least residuals.
#pragma once

#include <ddacontact/core/types.hpp>

#include <polyfem/core/parallel.hpp>

#include <cmath>
#include <vector>

namespace ddacontact {

/// What an iteration found.
struct KrylovReport {
  bool converged = false;
  int iterations = 0;  ///< of bicgstab, each with two products and two preconditionings, or of gmres
};

/// Calls work(begin, n) for parts of 0 .. size - 1, shared by threads, and sums what it returns in their
/// order.
template <class Work>
auto sum_of_parts(Index size, const Work& work) {
  constexpr Index part = 4096;
  using Sum = decltype(work(Index(0), Index(0)));
  if (size <= part) return work(0, size);
  std::vector<Sum> sums(static_cast<std::size_t>((size + part - 1) / part));
  polyfem::for_ranges(size, part, [&](Index begin, Index end) {
    sums[static_cast<std::size_t>(begin / part)] = work(begin, end - begin);
  });
  for (std::size_t k = 1; k < sums.size(); ++k) sums[0] += sums[k];
  return sums[0];
}

/// Solves A x = b, A unsymmetric, from x = 0, to |b - A x| <= tolerance |b| by the recurrence (van der Vorst
/// 1992).
///
/// \param[in] apply  apply(b, x, y): x = about A^-1 b, y = A x
template <class Apply, class Vector>
KrylovReport bicgstab(const Apply& apply, const Vector& b, double tolerance, int most_iterations, Vector& x) {
  using Real = typename Vector::Scalar;
  using Two = Eigen::Array2d;
  KrylovReport report;
  const Index n = b.size();
  x.setZero(n);
  Vector r = b, p = b, q(n), v(n), t(n);
  double rho = sum_of_parts(n, [&](Index k, Index m) -> double { return b.segment(k, m).squaredNorm(); });
  const double enough = tolerance * tolerance * rho;
  if (rho == 0) return {true, 0};
  while (report.iterations < most_iterations) {
    ++report.iterations;
    apply(p, q, v);
    const double alpha = rho / sum_of_parts(n, [&](Index k, Index m) -> double {
                           return b.segment(k, m).dot(v.segment(k, m));
                         });
    if (!std::isfinite(alpha)) return report;
    const auto along_p = static_cast<Real>(alpha);
    const double half = sum_of_parts(n, [&](Index k, Index m) -> double {
      auto s = r.segment(k, m);
      s -= along_p * v.segment(k, m);
      x.segment(k, m) += along_p * q.segment(k, m);
      return s.squaredNorm();
    });
    if (half <= enough) {
      report.converged = true;
      return report;
    }
    apply(r, q, t);
    const Two products = sum_of_parts(n, [&](Index k, Index m) {
      const auto of_t = t.segment(k, m);
      return Two(of_t.dot(r.segment(k, m)), of_t.squaredNorm());
    });
    const double omega = products[0] / products[1];
    if (!std::isfinite(omega) || omega == 0) return report;
    const auto along_r = static_cast<Real>(omega);
    const Two sums = sum_of_parts(n, [&](Index k, Index m) {
      auto of_r = r.segment(k, m);
      x.segment(k, m) += along_r * q.segment(k, m);
      of_r -= along_r * t.segment(k, m);
      return Two(of_r.squaredNorm(), of_r.dot(b.segment(k, m)));
    });
    if (sums[0] <= enough) {
      report.converged = true;
      return report;
    }
    const double next = sums[1], beta = next / rho * alpha / omega;
    if (!std::isfinite(beta) || next == 0) return report;
    const auto of_before = static_cast<Real>(beta);
    sum_of_parts(n, [&](Index k, Index m) {
      auto of_p = p.segment(k, m);
      of_p = r.segment(k, m) + of_before * (of_p - along_r * v.segment(k, m));
      return 0.0;
    });
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
        h[static_cast<Index>(i)] += along;
      }
    const double left = h[static_cast<Index>(k) + 1] = w.norm();
    for (std::size_t i = 0; i < k; ++i) {
      double &upper = h[static_cast<Index>(i)], &lower = h[static_cast<Index>(i) + 1];
      const double before = upper;
      upper = cosine[i] * before + sine[i] * lower;
      lower = cosine[i] * lower - sine[i] * before;
    }
    const double length = std::hypot(h[static_cast<Index>(k)], left);
    if (!(length > 0) || !std::isfinite(length)) break;
    cosine.push_back(h[static_cast<Index>(k)] / length);
    sine.push_back(left / length);
    h[static_cast<Index>(k)] = length;
    R.push_back(std::move(h));
    g.push_back(-sine[k] * g[k]);
    g[k] *= cosine[k];
    ++report.iterations;
    report.converged = std::abs(g[k + 1]) <= tolerance * scale;
    if (left == 0) break;
    basis.push_back(w / left);
  }
  for (std::size_t i = R.size(); i-- > 0;) {
    g[i] /= R[i][static_cast<Index>(i)];
    for (std::size_t k = 0; k < i; ++k) g[k] -= R[i][static_cast<Index>(k)] * g[i];
    x += g[i] * basis[i];
  }
  return report;
}

}  // namespace ddacontact
