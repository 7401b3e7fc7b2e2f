#include <polyfem/assembly/prescribed_dofs.hpp>

#include <algorithm>
#include <utility>

namespace polyfem {

bool PrescribedDofs::hold(int unknown, double value) {
  values_[unknown] = value;
  return std::exchange(prescribed_[static_cast<std::size_t>(unknown)], char{1}) == 0;
}

void PrescribedDofs::release_all() {
  std::fill(prescribed_.begin(), prescribed_.end(), char{0});
  values_.setZero();
}

void PrescribedDofs::take_out(SparseMatrix& lower) {
  const int* const outer = lower.outerIndexPtr();
  const int* const row = lower.innerIndexPtr();
  double* const value = lower.valuePtr();
  for (int column = 0; column < lower.cols(); ++column) {
    const bool column_prescribed = is_prescribed(column);
    for (int slot = outer[column]; slot < outer[column + 1]; ++slot)
      if (column_prescribed || is_prescribed(row[slot]))
        couplings_.push_back(
            {row[slot], column, slot, std::exchange(value[slot], row[slot] == column ? 1. : 0.)});
  }
}

void PrescribedDofs::put_back(SparseMatrix& lower) {
  for (const Coupling& coupling : couplings_) lower.valuePtr()[coupling.slot] = coupling.value;
  couplings_.clear();
}

void PrescribedDofs::move_to_right_hand_side(VectorXd& f) const {
  for (const auto& [row, column, slot, value] : couplings_) {
    if (is_prescribed(column)) f[row] -= value * values_[column];
    if (is_prescribed(row)) f[column] -= value * values_[row];
  }
  set_values(f);
}

void PrescribedDofs::set_values(VectorXd& u) const {
  for (int k = 0; k < u.size(); ++k)
    if (is_prescribed(k)) u[k] = values_[k];
}

VectorXd PrescribedDofs::forces(const VectorXd& u) const {
  VectorXd f = VectorXd::Zero(u.size());
  for (const auto& [row, column, slot, value] : couplings_) {
    if (is_prescribed(row)) f[row] += value * u[column];
    if (is_prescribed(column) && column != row) f[column] += value * u[row];
  }
  return f;
}

}  // namespace polyfem
