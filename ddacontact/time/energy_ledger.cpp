#include <ddacontact/time/energy_ledger.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

void EnergyLedger::close_step() {
  for (double Energy::*entry : entries) {
    exchanged_ = std::max(exchanged_, std::abs(now.*entry - start_.*entry));
    largest_ = std::max(largest_, std::abs(now.*entry));
  }
}

double EnergyLedger::balance_error() const {
  constexpr double beyond_residuals = 1e-8;
  return exchanged_ > beyond_residuals * largest_ ? (now.total() - start_.total()) / exchanged_ : 0;
}

}  // namespace ddacontact
