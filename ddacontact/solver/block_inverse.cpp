#include <ddacontact/solver/block_inverse.hpp>

#include <ddacontact/block/for_blocks.hpp>
#include <ddacontact/solver/small_product.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <atomic>

namespace ddacontact {

bool BlockInverse::set_matrices(FrictionProblem& problem) {
  unknowns_ = &problem.unknowns();
  equation_ = &problem.equation();
  block_of_.assign(equation_->size(), -1);
  place_.assign(equation_->size(), -1);
  first_.assign(1, 0);
  size_.clear();
  for (int b = 0; b < unknowns_->n_elements(); ++b) {
    const std::span<const int> of_block = unknowns_->rows_of(b);
    const bool held =
        std::ranges::all_of(of_block, [&](int u) { return (*equation_)[static_cast<std::size_t>(u)] < 0; });
    if (!held && of_block.size() > largest_block) return false;
    size_.push_back(held ? 0 : static_cast<int>(of_block.size()));
    first_.push_back(first_.back() + static_cast<std::size_t>(size_.back()) * size_.back());
  }
  values_.resize(first_.back());
  for (int b = 0; b < unknowns_->n_elements(); ++b) {
    if (size_[static_cast<std::size_t>(b)] == 0) continue;
    const std::span<const int> of_block = unknowns_->rows_of(b);
    View A = view(b);
    A = problem.elements()[static_cast<std::size_t>(b)];
    for (std::size_t k = 0; k < of_block.size(); ++k) {
      const std::size_t u = static_cast<std::size_t>(of_block[k]);
      if (block_of_[u] >= 0) return false;
      const Index place = static_cast<Index>(k);
      if ((*equation_)[u] < 0) {
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
    View A = view(block);
    for (std::size_t j = 0; j < u.size(); ++j)
      if (block_of(u[j]) == block) A(place_in_block(u[i]), place_in_block(u[j])) += stiffness * a[i] * a[j];
  }
}

bool BlockInverse::invert() {
  using Small =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, largest_block, largest_block>;
  std::atomic<bool> definite = true;
  for_blocks(unknowns_->n_elements(), [&](int b) {
    if (size_[static_cast<std::size_t>(b)] == 0) return;
    View A = view(b);
    const Eigen::LLT<Small> factor(A);
    if (factor.info() == Eigen::Success)
      A = factor.solve(Small::Identity(A.rows(), A.cols()));
    else
      definite = false;
  });
  return definite;
}

void BlockInverse::apply(const VectorXd& b, VectorXd& x) const {
  x.setZero(b.size());
  for_blocks(unknowns_->n_elements(), [&](int block) {
    if (size_[static_cast<std::size_t>(block)] > 0)
      add_product(inverse(block), unknowns_->rows_of(block), b, x);
  });
  for (std::size_t u = 0; u < equation_->size(); ++u)
    if ((*equation_)[u] < 0) x[static_cast<Index>(u)] = 0;
}

}  // namespace ddacontact
