/// \file Sparse Cholesky factorization (CHOLMOD) that keeps its analysis while the pattern holds.
#pragma once

#include <polyfem/core/types.hpp>

#include <Eigen/SparseCore>

#include <memory>

namespace polyfem {

/// Compressed columns with int indices, as CHOLMOD takes them.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// K = L L^T of a symmetric positive definite matrix given by its lower triangle.
class Cholesky {
 public:
  Cholesky();
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  /// Finds the ordering and the pattern of L. Call again only when the pattern of K changes.
  void analyze(const SparseMatrix& lower);
  /// Computes L for the analyzed pattern; false when K is not positive definite (nothing to solve with then).
  [[nodiscard]] bool factorize(const SparseMatrix& lower);
  /// x = K^-1 b with the last factor.
  void solve(const VectorXd& b, VectorXd& x);

  int n_analyses() const { return n_analyses_; }
  int n_factorizations() const { return n_factorizations_; }
  int n_solves() const { return n_solves_; }

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  int n_analyses_ = 0, n_factorizations_ = 0, n_solves_ = 0;
};

}  // namespace polyfem
