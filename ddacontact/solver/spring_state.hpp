/// \file Which springs of a contact act, and where friction has reached its bound.
#pragma once

#include <ddacontact/contact/contact.hpp>
#include <ddacontact/solver/contact_term.hpp>

namespace ddacontact {

/// The state that the step before left.
unsigned char first_state(const Contact& contact, bool sheared);
/// The state of the law where the springs are evaluated. A bond that is pulled with its strength bears shear
/// still.
unsigned char state_at(const ContactTerm& term, const JointLaw& law, const ContactSprings& springs);
/// The state in which a contact exerts this force.
unsigned char state_of(const ContactTerm& term, const JointLaw& law, bool bonded, const ContactForce& force);
/// The forces when the springs of a state act, however far: not clipped. The bound of friction goes on below
/// N = 0, that of a bond stays.
ContactForce force_in_state(const JointLaw& law, bool bonded, unsigned char state,
                            const ContactSprings& springs);
/// The state to try after one that is not the law's at d, `at_d`: from sliding one way to the other only by
/// way of sticking.
unsigned char next_state(unsigned char state, unsigned char at_d);

}  // namespace ddacontact
