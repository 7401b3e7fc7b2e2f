#include <ddacontact/contact/joint_law.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

double normal_force(const JointLaw& law, double gap) { return -law.normal_stiffness * gap; }

double shear_bound(const JointLaw& law, double normal_force, bool bonded) {
  return std::max(0.0, normal_force) * law.friction + (bonded ? law.cohesion : 0.0);
}

ContactState next_state(ContactState state, const JointLaw& law, const Trial& trial) {
  const ContactState closed = law.frictionless() ? ContactState::slip_forward : ContactState::stick;
  if (state == ContactState::open) return trial.gap < -trial.tolerance ? closed : ContactState::open;

  const double N = normal_force(law, trial.gap);
  const double tension = trial.bonded ? law.tension : 0.0;
  if (N < -tension - law.normal_stiffness * trial.tolerance) return ContactState::open;
  if (law.frictionless()) return closed;

  if (state == ContactState::stick) {
    const double bound = shear_bound(law, N, trial.bonded) + law.tangential_stiffness * trial.tolerance;
    if (std::abs(law.tangential_stiffness * trial.slip) <= bound) return ContactState::stick;
    return trial.slip > 0 ? ContactState::slip_forward : ContactState::slip_backward;
  }
  return slip_sign(state) * trial.slip_increment < -trial.tolerance ? ContactState::stick : state;
}

}  // namespace ddacontact
