/// \file The inverse of a matrix without what couples its blocks.
#pragma once

#include <ddacontact/solver/friction_problem.hpp>

#include <vector>

namespace ddacontact {

/// (A + springs)^-1 block by block, where each matrix of a FrictionProblem is over unknowns of its own, few
/// of them.
class BlockInverse {
 public:
  static constexpr int largest_block = 16;  ///< unknowns
  /// Takes A. False: its matrices share unknowns, or are larger.
  [[nodiscard]] bool set_matrices(FrictionProblem& problem);
  /// Adds the parts of stiffness * a a^T that lie within blocks.
  void add_spring(double stiffness, const AffineForm& form);
  /// False: a block is not positive definite.
  [[nodiscard]] bool invert();

  /// x = inverse b on the free unknowns, 0 on the held ones.
  void apply(const VectorXd& b, VectorXd& x) const;

  /// The block of an unknown, -1: it is held or of none; and its place in the block.
  int block_of(int unknown) const { return block_of_[static_cast<std::size_t>(unknown)]; }
  int place_in_block(int unknown) const { return place_[static_cast<std::size_t>(unknown)]; }
  /// After `invert`; of held unknowns the identity.
  Eigen::Map<const MatrixXd> inverse(int block) const {
    const Index n = unknowns_->first[block + 1] - unknowns_->first[block];
    return {values_.data() + first_[static_cast<std::size_t>(block)], n, n};
  }

 private:
  Eigen::Map<MatrixXd> matrix(int block) {
    const Eigen::Map<const MatrixXd> inverse = this->inverse(block);
    return {values_.data() + first_[static_cast<std::size_t>(block)], inverse.rows(), inverse.cols()};
  }

  const polyfem::Connectivity* unknowns_ = nullptr;
  std::vector<int> block_of_, place_;
  std::vector<double> values_;      ///< of all matrices
  std::vector<std::size_t> first_;  ///< of each block
};

}  // namespace ddacontact
