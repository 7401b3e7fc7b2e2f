/// \file The chapters of doc/verification/mechanics.md.
#pragma once

#include "report.hpp"

namespace verification {

void spinning(Report& report);
void tumbling(Report& report);
void sliding_over_steps(Report& report);
void colliding(Report& report);
void resting(Report& report);
void resting_long(Report& report);  ///< only when asked for by name: minutes
void toppling(Report& report);
void energy_ledger(Report& report);
void choice_of_scheme(Report& report);
void far_from_the_origin(Report& report);

}  // namespace verification
