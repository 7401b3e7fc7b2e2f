/// \file Inverses of the small dense matrices of blocks, and products with them.
#pragma once

#include <ddacontact/core/types.hpp>

#include <cmath>

namespace ddacontact {

namespace small_inverse {

/// A column of a matrix of N rows, or of any number up to 16.
template <int N, class Real = double>
using Column = Eigen::Matrix<Real, N, 1, Eigen::ColMajor, N == Eigen::Dynamic ? 16 : N, 1>;

/// The same as invert below, of matrices of N rows.
template <int N>
bool invert(double* values, int n) {
  Eigen::Map<Eigen::Matrix<double, N, N>> A(values, n, n);
  for (Index p = 0; p < n; ++p) {
    const double inverse = 1 / A(p, p);
    if (!std::isfinite(inverse)) return false;
    Column<N> column = A.col(p);
    column[p] = 0;
    for (Index k = 0; k < n; ++k) {
      if (k == p) continue;
      const double factor = A(p, k) * inverse;
      A.col(k) -= factor * column;
      A(p, k) = factor;
    }
    A.col(p) = -inverse * column;
    A(p, p) = inverse;
  }
  return true;
}

/// The same as multiply below, of matrices of N rows.
template <int N, class Real>
void multiply(const Real* values, int n, const Real* x, Real* y) {
  const Eigen::Map<const Eigen::Matrix<Real, N, N>> A(values, n, n);
  Column<N, Real> sum = A.col(0) * x[0];
  for (Index k = 1; k < n; ++k) sum += A.col(k) * x[k];
  Eigen::Map<Column<N, Real>>(y, n) = sum;
}

}  // namespace small_inverse

/// The n x n matrix of these values, n <= 16, becomes its inverse, by elimination in place without exchanging
/// rows. False: it has none that is finite.
inline bool invert(double* values, int n) {
  return n == 8   ? small_inverse::invert<8>(values, 8)
         : n == 6 ? small_inverse::invert<6>(values, 6)
                  : small_inverse::invert<Eigen::Dynamic>(values, n);
}

/// y = A x with the n x n matrix of these values, n <= 16.
template <class Real>
void multiply(const Real* values, int n, const Real* x, Real* y) {
  if (n == 8)
    small_inverse::multiply<8>(values, 8, x, y);
  else if (n == 6)
    small_inverse::multiply<6>(values, 6, x, y);
  else
    small_inverse::multiply<Eigen::Dynamic>(values, n, x, y);
}

}  // namespace ddacontact
