/// \file Sparse LU factorization (UMFPACK) that keeps its analysis while the pattern holds.
#pragma once

#include <polyfem/assembly/cholesky.hpp>

namespace polyfem {

/// K = L U of a matrix with a symmetric pattern, whose entries need not be symmetric. Pivots are taken from
/// the diagonal unless they are small, so rows and columns should be scaled alike.
class SparseLu {
 public:
  SparseLu();
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// Finds the ordering. Call again only when the pattern of K changes.
  void analyze(const SparseMatrix& matrix);
  /// Computes L and U for the analyzed pattern; false when K is singular (nothing to solve with then).
  [[nodiscard]] bool factorize(const SparseMatrix& matrix);
  /// x = K^-1 b with the last factors. \param[in] matrix  what was factorized
  void solve(const SparseMatrix& matrix, const VectorXd& b, VectorXd& x);

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace polyfem
