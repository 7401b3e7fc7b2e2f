/// \file The chapters of doc/verification/dda.md.
#pragma once

#include <report.hpp>

namespace validation {

using verification::Claim;
using verification::Report;

void sliding(Report& report);       ///< blocks that slide, stiff and soft, after they settled
void velocities(Report& report);    ///< sliding with and against an initial velocity
void newmark(Report& report);       ///< Newmark's block on a shaken base
void wedge(Report& report);         ///< a wedge between two planes
void chart(Report& report);         ///< whether one block on a slope slides or topples
void goodman_bray(Report& report);  ///< a slope of columns that topple
void arch(Report& report);          ///< the least thickness of a semicircular arch
void silo(Report& report);          ///< Janssen's silo
void column(Report& report);        ///< a column under its weight
void rocking(Report& report);       ///< a rocking block
void flight(Report& report);        ///< free fall, a projectile and a spinning block
void colliding(Report& report);     ///< head-on and oblique collisions
void cantilever(Report& report);    ///< a cantilever, and a cantilevered wall of blocks
void wave(Report& report);          ///< a pressure wave along a bar of blocks

}  // namespace validation
