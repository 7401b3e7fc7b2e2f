/// \file The penalty springs of a contact, (38) to (50): what state a contact is in after a trial solution.
/// Pure functions on values.
#pragma once

#include <ddacontact/contact/joint_law.hpp>

namespace ddacontact {

/// A trial solution seen by one contact.
struct Trial {
  double gap = 0;             ///< at the end of the step; < 0 is penetration
  double slip = 0;            ///< distance from the lock point at the end of the step, along j to k
  double slip_increment = 0;  ///< change of the slip within the step
  double tolerance = 0;       ///< lengths below this are round-off
  bool on_edge = true;        ///< at the start or at the end of the step the vertex projects onto the edge
  bool bonded = false;        ///< cohesion and tensile strength hold
};

/// N = -p g of a closed contact; > 0 is compression.
double normal_force(const JointLaw& law, double gap);
/// The state that agrees with the trial, from the state it was computed with: an open contact closes on
/// penetration of the edge (not of the line beyond it); a closed one opens when pulled beyond the tensile
/// bound; a contact that closes or sticks slips when its spring would exceed the shear bound, also when it is
/// pulled as well but sheared by more; a slipping one that moved against its own sense is judged by its
/// spring anew (a contact that stuck before may spring back while it slips, when its bound falls). A closed
/// contact without friction is slip_forward.
ContactState next_state(ContactState state, const JointLaw& law, const Trial& trial);

}  // namespace ddacontact
