#include <ddacontact/time/energy_ledger.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

void EnergyLedger::close_step() {
  for (double Energy::*entry :
       {&Energy::kinetic, &Energy::elastic, &Energy::gravity, &Energy::friction_dissipated,
        &Energy::numerical_dissipated, &Energy::external, &Energy::damping_dissipated})
    exchanged_ = std::max(exchanged_, std::abs(now.*entry - start_.*entry));
}

}  // namespace ddacontact
