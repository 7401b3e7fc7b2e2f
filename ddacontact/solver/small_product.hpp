/// \file Products of the small dense matrices of blocks with vectors of all unknowns.
#pragma once

#include <ddacontact/core/types.hpp>

#include <span>

namespace ddacontact {

/// Unknowns of a block of four vertices, which most scenes are made of.
inline constexpr int quadrilateral = 8;

/// y(unknowns) += A x(unknowns). Blocks whose unknowns are consecutive, of four vertices above all, are
/// quick.
inline void add_product(const Eigen::Ref<const MatrixXd>& A, std::span<const int> unknowns, const VectorXd& x,
                        VectorXd& y) {
  const auto n = static_cast<Index>(unknowns.size());
  if (n == 0) return;
  const int first = unknowns.front();
  bool consecutive = true;
  for (Index k = 0; k < n; ++k) consecutive = consecutive && unknowns[k] == first + k;
  if (!consecutive) {
    for (Index l = 0; l < n; ++l)
      for (Index k = 0; k < n; ++k) y[unknowns[k]] += A(k, l) * x[unknowns[l]];
  } else if (n == quadrilateral && A.outerStride() == n) {
    const Eigen::Map<const Eigen::Matrix<double, quadrilateral, quadrilateral>> known(A.data());
    Eigen::Matrix<double, quadrilateral, 1> sum = known.col(0) * x[first];
    for (Index l = 1; l < quadrilateral; ++l) sum += known.col(l) * x[first + l];
    y.segment<quadrilateral>(first) += sum;
  } else {
    y.segment(first, n).noalias() += A * x.segment(first, n);
  }
}

}  // namespace ddacontact
