#include <ddacontact/solver/block_inverse.hpp>

#include <Eigen/Cholesky>

#include <algorithm>

namespace ddacontact {

bool BlockInverse::set_matrices(FrictionProblem& problem) {
  unknowns_ = &problem.unknowns();
  const std::vector<int>& equation = problem.equation();
  block_of_.assign(equation.size(), -1);
  place_.assign(equation.size(), -1);
  matrices_.resize(static_cast<std::size_t>(unknowns_->n_elements()));
  for (int b = 0; b < unknowns_->n_elements(); ++b) {
    const std::span<const int> of_block = unknowns_->rows_of(b);
    const bool held =
        std::ranges::all_of(of_block, [&](int u) { return equation[static_cast<std::size_t>(u)] < 0; });
    if (held) {
      matrices_[static_cast<std::size_t>(b)].resize(0, 0);
      continue;
    }
    if (of_block.size() > largest_block) return false;
    Matrix& A = matrices_[static_cast<std::size_t>(b)];
    A = problem.elements()[static_cast<std::size_t>(b)];
    for (std::size_t k = 0; k < of_block.size(); ++k) {
      const std::size_t u = static_cast<std::size_t>(of_block[k]);
      if (block_of_[u] >= 0) return false;
      const Index place = static_cast<Index>(k);
      if (equation[u] < 0) {
        A.row(place).setZero();
        A.col(place).setZero();
        A(place, place) = 1;
        continue;
      }
      block_of_[u] = b;
      place_[u] = static_cast<int>(k);
    }
  }
  return true;
}

void BlockInverse::add_spring(double stiffness, const AffineForm& form) {
  const std::span<const int> u = form.unknowns();
  const std::span<const double> a = form.coefficients();
  for (std::size_t i = 0; i < u.size(); ++i) {
    const int block = block_of(u[i]);
    if (block < 0) continue;
    Matrix& A = matrices_[static_cast<std::size_t>(block)];
    for (std::size_t j = 0; j < u.size(); ++j)
      if (block_of(u[j]) == block) A(place_in_block(u[i]), place_in_block(u[j])) += stiffness * a[i] * a[j];
  }
}

bool BlockInverse::invert() {
  for (Matrix& A : matrices_) {
    if (A.size() == 0) continue;
    const Eigen::LLT<Matrix> factor(A);
    if (factor.info() != Eigen::Success) return false;
    A = factor.solve(Matrix::Identity(A.rows(), A.cols()));
  }
  return true;
}

void BlockInverse::apply(const VectorXd& b, VectorXd& x) const {
  x.setZero(b.size());
  for (int block = 0; block < unknowns_->n_elements(); ++block) {
    const std::span<const int> of_block = unknowns_->rows_of(block);
    const Matrix& inverse = matrices_[static_cast<std::size_t>(block)];
    for (std::size_t l = 0; l < of_block.size(); ++l) {
      if (block_of(of_block[l]) < 0) continue;
      const double value = b[of_block[l]];
      for (std::size_t k = 0; k < of_block.size(); ++k)
        x[of_block[k]] += inverse(static_cast<Index>(k), static_cast<Index>(l)) * value;
    }
  }
}

}  // namespace ddacontact
