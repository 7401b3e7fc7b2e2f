/// \file Sparse LU factorization (UMFPACK), for systems without symmetry.
#pragma once

#include <polyfem/assembly/cholesky.hpp>

#include <memory>

namespace polyfem {

/// P A Q = L U of a square matrix that need not be symmetric.
class Lu {
 public:
  Lu();
  ~Lu();
  Lu(Lu&&) noexcept;
  Lu& operator=(Lu&&) noexcept;

  /// Keeps A and makes its factors; false when it is singular to round-off (nothing to solve with then).
  [[nodiscard]] bool factorize(SparseMatrix A);
  /// x = A^-1 b with the last factors, improved by a residual.
  void solve(const VectorXd& b, VectorXd& x) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace polyfem
