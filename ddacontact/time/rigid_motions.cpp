#include <ddacontact/time/rigid_motions.hpp>

#include <ddacontact/core/tolerances.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>

namespace ddacontact {

namespace {

/// Those of a block's own unknowns.
std::vector<Index> prescribed_unknowns(const BlockSystem& blocks, const Block& block) {
  const auto [first, count] = block.unknowns();
  std::vector<Index> held;
  for (int k = 0; k < count; ++k)
    if (blocks.equation()[first + k] < 0) held.push_back(k);
  return held;
}

/// With a rotation that is comparable to the translations.
MatrixXd scaled_modes(const Block& block, const BlockState& state) {
  MatrixXd modes = block.rigid_modes(state);
  modes.col(2) /= block.size();
  return modes;
}

/// Combinations of the rigid modes that do not move the prescribed degrees of freedom.
MatrixXd allowed_modes(const BlockSystem& blocks, const BlockState& state, const Block& block) {
  const std::vector<Index> held = prescribed_unknowns(blocks, block);
  if (held.empty()) return block.rigid_modes(state);
  const MatrixXd modes = scaled_modes(block, state);
  Eigen::FullPivLU<MatrixXd> rows(modes(held, Eigen::all));
  rows.setThreshold(length_round_off);
  if (rows.dimensionOfKernel() == 0) return MatrixXd(modes.rows(), 0);
  MatrixXd allowed = modes * rows.kernel();
  allowed(held, Eigen::all).setZero();
  return allowed;
}

}  // namespace

RigidMotions::RigidMotions(const BlockSystem& blocks, const BlockState& state, std::span<const int> of_blocks)
    : part_of_unknown_(static_cast<std::size_t>(blocks.n_unknowns()), -1) {
  for (int b : of_blocks) {
    const Block& block = blocks.block(b);
    MatrixXd modes = allowed_modes(blocks, state, block);
    if (modes.cols() == 0) continue;
    const Eigen::LLT<MatrixXd> mass(modes.transpose() * block.times_mass(modes));
    const MatrixXd normalized = mass.matrixL().solve(modes.transpose());
    std::fill_n(part_of_unknown_.begin() + block.unknowns().first, block.unknowns().count,
                static_cast<int>(parts_.size()));
    parts_.push_back({&block, n_coefficients_, normalized.transpose()});
    n_coefficients_ += static_cast<int>(modes.cols());
  }
}

VectorXd RigidMotions::coefficients(const VectorXd& velocity) const {
  VectorXd q(n_coefficients_);
  for (const Part& part : parts_) {
    const auto [first, count] = part.block->unknowns();
    q.segment(part.first, part.modes.cols()) =
        part.modes.transpose() * part.block->times_mass(velocity.segment(first, count)).col(0);
  }
  return q;
}

void RigidMotions::add_motion(const VectorXd& q, VectorXd& velocity) const {
  for (const Part& part : parts_) {
    const auto [first, count] = part.block->unknowns();
    velocity.segment(first, count) += part.modes * q.segment(part.first, part.modes.cols());
  }
}

double RigidMotions::largest_mass() const {
  double largest = 0;
  for (const Part& part : parts_) largest = std::max(largest, part.block->mass_total());
  return largest;
}

VectorXd driven_motion(const BlockSystem& blocks, const BlockState& state, const Block& block,
                       const VectorXd& velocity) {
  const std::vector<Index> held = prescribed_unknowns(blocks, block);
  if (held.empty()) return VectorXd::Zero(block.unknowns().count);
  const MatrixXd modes = scaled_modes(block, state), of_held = modes(held, Eigen::all);
  const VectorXd driven = block.unknowns().of(velocity)(held);
  return modes * Eigen::CompleteOrthogonalDecomposition<MatrixXd>(of_held).solve(driven);
}

AffineForm RigidMotions::rate_form(const AffineForm& form) const {
  std::vector<int> moving;  // parts, in the order in which they occur
  for (int u : form.unknowns())
    if (const int p = part_of_unknown_[u]; p >= 0 && std::ranges::count(moving, p) == 0) moving.push_back(p);
  AffineForm rate;
  for (int p : moving) {
    const Part& part = parts_[p];
    for (int m = 0; m < part.modes.cols(); ++m) {
      double sum = 0, magnitude = 0;
      form.for_terms([&](int u, double coefficient) {
        if (part_of_unknown_[u] != p) return;
        const double term = coefficient * part.modes(u - part.block->unknowns().first, m);
        sum += term;
        magnitude += std::abs(term);
      });
      rate.append(part.first + m, std::abs(sum) > length_round_off * magnitude ? sum : 0);
    }
  }
  return rate;
}

}  // namespace ddacontact
