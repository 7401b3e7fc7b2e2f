/// \file The chapters of doc/verification/jointed_rock.md.
#pragma once

#include <doc/verification/report.hpp>

namespace jointed_rock {

using verification::Claim;
using verification::Report;

/// Blocks that slide over flush joints and crossings, and into a shaft.
void flush_joints(Report& report);
/// Random slopes and slabs below and above the friction that holds them; all slopes as recorded.
void random_slopes(Report& report);
/// Factors of safety of random slopes by strength reduction.
void factors_of_safety(Report& report);
/// Random arches and walls at parts of their limit, in static steps.
void arches_walls(Report& report);

}  // namespace jointed_rock
