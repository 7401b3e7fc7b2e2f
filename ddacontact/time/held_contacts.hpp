/// \file Velocities of blocks that stay in touch.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>

#include <vector>

namespace ddacontact {

/// What holding contacts took with it.
struct HoldReport {
  double friction_loss = 0;  ///< what friction of sliding contacts dissipated, J per m
  bool settled = true;       ///< that friction agrees with the normal impulses; if not, it is left out
};

/// Takes out of `next.velocity` the rates of the gaps of contacts that press at the end of a step of length
/// dt, and of the slips of those that stick: rigid motions of the blocks, of least kinetic energy. v1 = 2 d /
/// dt - v0 would hand on whatever rate a contact had when it closed, with its sign changed at every step.
/// Sliding contacts add the friction that goes with the normal impulses, where the two come to agree.
/// Prepares the blocks for `next`.
HoldReport hold_closed_contacts(BlockSystem& blocks, const std::vector<Contact>& all, const VectorXd& d,
                                double dt, BlockState& next);

}  // namespace ddacontact
