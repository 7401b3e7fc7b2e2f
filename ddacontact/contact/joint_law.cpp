#include <ddacontact/contact/joint_law.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

double normal_force(const JointLaw& law, double gap) { return -law.normal_stiffness * gap; }

double shear_bound(const JointLaw& law, double normal_force, bool bonded) {
  return std::max(0.0, normal_force) * law.friction + (bonded ? law.cohesion : 0.0);
}

namespace {

/// Stick, unless the tangential spring would pull with more than the bound.
ContactState stick_or_slip(const JointLaw& law, const Trial& trial) {
  const double bound = shear_bound(law, normal_force(law, trial.gap), trial.bonded);
  if (law.tangential_stiffness * (std::abs(trial.slip) - trial.tolerance) <= bound) return ContactState::stick;
  return trial.slip > 0 ? ContactState::slip_forward : ContactState::slip_backward;
}

}  // namespace

ContactState next_state(ContactState state, const JointLaw& law, const Trial& trial) {
  const double tension = state != ContactState::open && trial.bonded ? law.tension : 0.0;
  const double opening_gap = tension / law.normal_stiffness;
  const bool closed = state == ContactState::open ? trial.on_edge && trial.gap < -trial.tolerance
                                                  : trial.gap <= opening_gap + trial.tolerance;
  if (!closed) return ContactState::open;
  if (law.frictionless()) return ContactState::slip_forward;
  if (is_slipping(state)) return slip_sign(state) * trial.slip_increment < -trial.tolerance ? ContactState::stick : state;
  return stick_or_slip(law, trial);
}

}  // namespace ddacontact
