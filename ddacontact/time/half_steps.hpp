/// \file The velocity at the end of a step from those in the middle of this step and of the next one.
#pragma once

#include <ddacontact/block/block_system.hpp>

namespace ddacontact {

/// The velocity at the time of a state whose scheme has half steps, of second order: between the one that it
/// carries on and that in the middle of the next step. Of free blocks the rigid part is what half of the
/// impulse of the next step leaves, without the residual of that step.
///
/// \param[in] after     in the middle of the next step, on the shapes of the state
/// \param[in] dt        of the next step, s
/// \param[in] external  all forces on the blocks in the next step; null: others give impulses too
VectorXd velocity_between(const BlockSystem& blocks, const BlockState& state, const VectorXd& after,
                          double dt, const VectorXd* external);

}  // namespace ddacontact
