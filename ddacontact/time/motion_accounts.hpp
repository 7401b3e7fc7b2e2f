/// \file Energies of a step by the blocks' motions.
#pragma once

#include <ddacontact/contact/contact.hpp>
#include <ddacontact/equations/step_system.hpp>
#include <ddacontact/time/energy_ledger.hpp>

#include <vector>

namespace ddacontact {

/// Adds what impulses take of the kinetic energy where blocks meet, J per m. Friction that gives back energy
/// gives what the normal impulses have taken; what all of them give counts as pushed out.
void account_losses(double by_normal, double by_friction, Energy& energy);

/// Adds the energy changes of an accepted step by the blocks' motions, but for the change of kinetic
/// energy. An impulse works on the straight motion of the shape at the start. What turns away from that on
/// the way, of slips and of prescribed points, is the scheme's. Gap and slip changes of the contacts become
/// those of the straight motion.
/// \param[in] from      where it starts: shifted and jumped by an impact
/// \param[in] straight  the straight motion of all unknowns
/// \param[in] residual  reactions of prescribed degrees of freedom
void account_motion_step(const StepSystem& system, const BlockState& from, const VectorXd& straight,
                         const Residual& residual, std::vector<Contact>& contacts, Energy& energy);

}  // namespace ddacontact
