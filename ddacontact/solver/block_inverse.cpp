#include <ddacontact/solver/block_inverse.hpp>

#include <ddacontact/block/for_blocks.hpp>

#include <Eigen/Cholesky>

#include <atomic>

namespace ddacontact {

bool BlockInverse::set_matrices(FrictionProblem& problem) {
  unknowns_ = &problem.unknowns();
  const std::vector<int>& equation = problem.equation();
  block_of_.assign(equation.size(), -1);
  place_.assign(equation.size(), -1);
  first_.assign(1, 0);
  for (int b = 0; b < unknowns_->n_elements(); ++b) {
    const std::size_t n = unknowns_->rows_of(b).size();
    if (n > largest_block) return false;
    first_.push_back(first_.back() + n * n);
  }
  values_.resize(first_.back());
  for (int b = 0; b < unknowns_->n_elements(); ++b) {
    const std::span<const int> of_block = unknowns_->rows_of(b);
    auto A = matrix(b);
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
    auto A = matrix(block);
    for (std::size_t j = 0; j < u.size(); ++j)
      if (block_of(u[j]) == block) A(place_in_block(u[i]), place_in_block(u[j])) += stiffness * a[i] * a[j];
  }
}

bool BlockInverse::invert() {
  using Matrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, largest_block, largest_block>;
  std::atomic<bool> definite = true;
  for_blocks(unknowns_->n_elements(), [&](int block) {
    auto A = matrix(block);
    const Eigen::LLT<Matrix> factor(A);
    if (factor.info() == Eigen::Success)
      A = factor.solve(Matrix::Identity(A.rows(), A.cols()));
    else
      definite = false;
  });
  return definite;
}

void BlockInverse::apply(const VectorXd& b, VectorXd& x) const {
  x.setZero(b.size());
  for_blocks(unknowns_->n_elements(), [&](int block) {
    const std::span<const int> of_block = unknowns_->rows_of(block);
    const auto inverse = this->inverse(block);
    for (std::size_t l = 0; l < of_block.size(); ++l) {
      if (block_of(of_block[l]) < 0) continue;
      const double value = b[of_block[l]];
      for (std::size_t k = 0; k < of_block.size(); ++k)
        x[of_block[k]] += inverse(static_cast<Index>(k), static_cast<Index>(l)) * value;
    }
  });
}

}  // namespace ddacontact
