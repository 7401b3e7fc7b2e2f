#include <polyfem/assembly/reduced_system.hpp>

#include <utility>

namespace polyfem {

bool ReducedSystem::set(SparseMatrix A, Reduction reduction, bool symmetric) {
  A_ = std::move(A);
  T_ = std::move(reduction.T);
  g_ = std::move(reduction.g);
  symmetric_ = symmetric;
  if (T_.cols() == 0) return true;
  const SparseMatrix AT = A_ * T_;
  SparseMatrix reduced = SparseMatrix(T_.transpose()) * AT;
  if (!symmetric) return lu_.factorize(std::move(reduced));
  SparseMatrix lower = reduced.triangularView<Eigen::Lower>();
  lower.makeCompressed();
  cholesky_.analyze(lower);
  return cholesky_.factorize(lower);
}

VectorXd ReducedSystem::solve(const VectorXd& f) {
  if (T_.cols() == 0) return g_;
  const VectorXd reduced = T_.transpose() * (f - A_ * g_);
  VectorXd q;
  if (symmetric_)
    cholesky_.solve(reduced, q);
  else
    lu_.solve(reduced, q);
  return T_ * q + g_;
}

VectorXd ReducedSystem::reactions(const VectorXd& u, const VectorXd& f) const {
  VectorXd r = A_ * u - f;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_row = T_;
  VectorXd n_followers = VectorXd::Zero(T_.cols());
  for (Index k = 0; k < T_.outerSize(); ++k) n_followers[k] = T_.col(k).nonZeros();
  for (Index k = 0; k < by_row.rows(); ++k) {
    const Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator first(by_row, k);
    const bool is_free = by_row.row(k).nonZeros() == 1 && first.value() == 1 && n_followers[first.col()] == 1;
    if (is_free) r[k] = 0;
  }
  return r;
}

int ReducedSystem::failed_unknown() const {
  const int column = symmetric_ ? cholesky_.failed_row() : -1;
  return column < 0 ? -1 : SparseMatrix::InnerIterator(T_, column).row();
}

}  // namespace polyfem
