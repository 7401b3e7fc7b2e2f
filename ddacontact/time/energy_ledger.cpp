#include <ddacontact/time/energy_ledger.hpp>

#include <ddacontact/solver/contact_solver.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

void EnergyLedger::close_step(double tolerated) {
  assert(std::isfinite(now.total()) && tolerated >= 0);
  for (double Energy::*entry : entries) {
    exchanged_ = std::max(exchanged_, std::abs(now.*entry - start_.*entry));
    largest_ = std::max(largest_, std::abs(now.*entry));
  }
  tolerated_ = std::max(tolerated_, tolerated);
  const double created =
      (now.total() - now.numerical_dissipated) - (start_.total() - start_.numerical_dissipated);
  created_ = std::max(created_, std::min(created, created_last_) - tolerated_);
  created_last_ = created;
  pushed_at_once_ = std::max(pushed_at_once_, now.pushed_out - pushed_before_ - tolerated);
  pushed_before_ = now.pushed_out;
}

double EnergyLedger::created() const {
  return has_exchanged() ? created_ / exchanged_ : 0;
}

bool EnergyLedger::has_exchanged() const {
  return exchanged_ > ContactSolverOptions{}.residual_tolerance * largest_;
}

double EnergyLedger::balance_error() const {
  return has_exchanged() ? (now.total() - start_.total()) / exchanged_ : 0;
}

}  // namespace ddacontact
