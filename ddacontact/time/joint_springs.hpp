/// \file The springs that a joint has itself: their forces at the end of a step, and what they store.
#pragma once

#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/solver/contact_term.hpp>
#include <ddacontact/time/energy_ledger.hpp>

namespace ddacontact {

/// The forces of the springs of a closed contact, `law.compliant`, at the end of an accepted step, N per m;
/// without its dashpot. 0 where it has opened.
/// \param[in] means  the step's forces are those of both ends
ContactForce end_forces_of_joint(const Contact& contact, bool means);

/// What the springs of a contact store, J per m, for which `properties.is_compliant`: by the forces of its
/// history.
double energy_of_joint(const ContactProperties& properties, const ContactRecord& contact);

/// Adds what friction, damping and the scheme take in a step from the springs of a contact and what moves
/// them; before its history takes the forces of the end.
/// \param[in] means  see `end_forces_of_joint`
void account_joint_springs(const Contact& contact, bool means, Energy& energy);

/// What the springs of joints stored at the end of the step before, less what those of this one start with:
/// where contacts of other vertices stand for a part of a face, or a joint is closed that nobody saw closing.
/// \param[in] contacts  of the step, before their histories end
double lost_by_joints(const ContactProperties& properties, const std::vector<ContactRecord>& before,
                      const std::vector<Contact>& contacts);

}  // namespace ddacontact
