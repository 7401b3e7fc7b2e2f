#include <polyfem/assembly/held_unknowns.hpp>

#include <algorithm>
#include <utility>

namespace polyfem {

bool HeldUnknowns::hold(int unknown, double value) {
  values_[unknown] = value;
  return std::exchange(held_[static_cast<std::size_t>(unknown)], char{1}) == 0;
}

void HeldUnknowns::release_all() {
  std::fill(held_.begin(), held_.end(), char{0});
  values_.setZero();
}

void HeldUnknowns::take_out(SparseMatrix& lower) {
  const int* const outer = lower.outerIndexPtr();
  const int* const row = lower.innerIndexPtr();
  double* const value = lower.valuePtr();
  for (int column = 0; column < lower.cols(); ++column) {
    const bool column_held = is_held(column);
    for (int place = outer[column]; place < outer[column + 1]; ++place)
      if (column_held || is_held(row[place]))
        couplings_.push_back(
            {row[place], column, place, std::exchange(value[place], row[place] == column ? 1. : 0.)});
  }
}

void HeldUnknowns::put_back(SparseMatrix& lower) {
  for (const Coupling& coupling : couplings_) lower.valuePtr()[coupling.place] = coupling.value;
  couplings_.clear();
}

void HeldUnknowns::move_to_right_hand_side(VectorXd& f) const {
  for (const auto& [row, column, place, value] : couplings_) {
    if (is_held(column)) f[row] -= value * values_[column];
    if (is_held(row)) f[column] -= value * values_[row];
  }
  set_values(f);
}

void HeldUnknowns::set_values(VectorXd& u) const {
  for (int k = 0; k < u.size(); ++k)
    if (is_held(k)) u[k] = values_[k];
}

VectorXd HeldUnknowns::forces(const VectorXd& u) const {
  VectorXd f = VectorXd::Zero(u.size());
  for (const auto& [row, column, place, value] : couplings_) {
    if (is_held(row)) f[row] += value * u[column];
    if (is_held(column) && column != row) f[column] += value * u[row];
  }
  return f;
}

}  // namespace polyfem
