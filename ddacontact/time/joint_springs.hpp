/// \file The springs that a joint has itself: their forces at the end of a step, and their energy.
#pragma once

#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/solver/contact_term.hpp>
#include <ddacontact/time/energy_ledger.hpp>

#include <vector>

namespace ddacontact {

/// The forces of the springs of a closed contact, `law.compliant`, at the end of an accepted step, N per m;
/// without its dashpot. 0 where it has opened.
/// \param[in] means  the step's forces are those of both ends
ContactForce end_forces_of_joint(const Contact& contact, bool means);

/// Energy in the springs of a contact for which `properties.is_compliant`, J per m, by the forces of its
/// history.
double energy_of_joint(const ContactProperties& properties, const ContactRecord& contact);

/// Adds the energy that friction, damping and the scheme take in a step from the springs of a contact and
/// from their motion; to be called before its history takes the forces of the end.
/// \param[in] means  see `end_forces_of_joint`
void account_joint_springs(const Contact& contact, bool means, Energy& energy);

/// Energy in the springs of joints at the end of the step before less that at the start of this one, J per m:
/// it differs where contacts of other vertices stand for a part of a face, or a joint is closed without a
/// step in which it closed.
/// \param[in] contacts  of the step, before their histories end
double lost_by_joints(const ContactProperties& properties, const std::vector<ContactRecord>& before,
                      const std::vector<Contact>& contacts);

}  // namespace ddacontact
