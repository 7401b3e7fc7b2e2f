/// \file Velocities of blocks that stay in touch.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/time/hold.hpp>

#include <vector>

namespace ddacontact {

/// How that went.
struct HeldReport {
  double friction_loss = 0;  ///< what friction of the impulses dissipates, J per m
  bool settled = true;       ///< friction agrees with the impulses; if not, it was left out
};

/// Takes out of `next.velocity` the rates of the gaps of contacts that press at the end of a step of length
/// dt, and of the slips of those that stick: rigid motions of the blocks, of least kinetic energy. v1 = 2 d /
/// dt - v0 would hand on whatever rate a contact had when it closed, with its sign changed at every step.
/// Sliding contacts add the friction that goes with the normal impulses, unless that does not settle or would
/// make energy. Prepares the blocks for `next`.
/// \param[in] parted      contacts that an impact in the step drives apart: they pressed before it, and are
///                        left to themselves; empty: none
/// \param[in,out] factor  of the step before; what is found does not depend on it
HeldReport hold_closed_contacts(BlockSystem& blocks, const std::vector<Contact>& all,
                                const std::vector<char>& parted, const VectorXd& d, double dt,
                                HoldFactor& factor, BlockState& next);

}  // namespace ddacontact
