/// \file Velocities of unknowns that follow a history.
#pragma once

#include <ddacontact/block/block_system.hpp>

namespace ddacontact {

/// The velocity of a support at the end of a step, from the steps before and after; where it jumps, by much
/// more than in the steps beside, that before.
/// \param[in] time      at the end of the step, s
/// \param[in] end_time  of the analysis, s
double support_velocity(const PrescribedDof& held, double time, double dt, double end_time);

}  // namespace ddacontact
