/// \file Velocities of blocks that stay in touch.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>

#include <vector>

namespace ddacontact {

/// Takes out of `next.velocity` the rates of the gaps of contacts that press at the end of a step of length
/// dt, and of the slips of those that stick: rigid motions of the blocks, of least kinetic energy. v1 = 2 d /
/// dt - v0 would hand on whatever rate a contact had when it closed, with its sign changed at every step.
/// Sliding contacts add the friction that goes with the normal impulses. Prepares the blocks for `next`.
///
/// \returns what that friction dissipates, J per m
double hold_closed_contacts(BlockSystem& blocks, const std::vector<Contact>& all, const VectorXd& d,
                            double dt, BlockState& next);

}  // namespace ddacontact
