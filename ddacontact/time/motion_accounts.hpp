/// \file What a step by the blocks' motions leaves: energies, reactions, and how far each block is from
/// balance.
#pragma once

#include <ddacontact/contact/contact.hpp>
#include <ddacontact/solver/step_system.hpp>
#include <ddacontact/time/energy_ledger.hpp>

#include <vector>

namespace ddacontact {

/// The forces on a block, for the verdict on its balance, N per m.
struct BlockForceSum {
  double resultant = 0;  ///< |force| or |moment| / size, the larger: mass times acceleration
  double largest = 0;    ///< of weight, loads and reactions; contact forces are the contacts'
};

/// Adds what an accepted step by the blocks' motions did to the energies, but for the change of kinetic
/// energy. An impulse works on the straight motion of the shape at the start. What turns away from that on
/// the way, of slips and of prescribed points, is the scheme's. Gap and slip changes of the contacts become
/// those of the straight motion. \param[in] from      where it starts: shifted and jumped by an impact
/// \param[in] straight  the straight motion of all unknowns
/// \param[in] residual  reactions of prescribed degrees of freedom
void account_motion_step(const StepSystem& system, const BlockState& from, const VectorXd& straight,
                         const Residual& residual, std::vector<Contact>& contacts, Energy& energy);

/// The forces of all unknowns on a block: |force| or |moment| / size, the larger, N per m.
double size_of_forces(const Block& block, const VectorXd& forces);
/// The largest of weight, loads and reactions on a block, N per m.
double largest_force(const StepSystem& system, const Block& block, const Points& reactions);

/// Mass times acceleration of every block, and the largest force beside those of contacts.
std::vector<BlockForceSum> sum_forces(const StepSystem& system, const VectorXd& straight,
                                      const Points& reactions);

}  // namespace ddacontact
