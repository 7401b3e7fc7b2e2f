/// \file The chapters of doc/verification/blocks.md.
#pragma once

#include "report.hpp"

namespace verification {

void bending(Report& report);
void stress_inside(Report& report);
void disk(Report& report);
void shapes(Report& report);
void choice(Report& report);

}  // namespace verification
