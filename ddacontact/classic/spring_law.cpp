#include <ddacontact/classic/spring_law.hpp>

#include <cassert>
#include <cmath>

namespace ddacontact {

double normal_force(const JointLaw& law, double gap) {
  return -law.normal_stiffness * gap;
}

namespace {

/// Stick, unless the tangential spring would pull with more than the bound.
ContactState stick_or_slip(const JointLaw& law, const Trial& trial) {
  const double bound = shear_bound(law, normal_force(law, trial.gap), trial.bonded);
  if (law.tangential_stiffness * (std::abs(trial.slip) - trial.tolerance) <= bound)
    return ContactState::stick;
  return trial.slip > 0 ? ContactState::slip_forward : ContactState::slip_backward;
}

}  // namespace

ContactState next_state(ContactState state, const JointLaw& law, const Trial& trial) {
  assert(law.normal_stiffness > 0 && trial.tolerance >= 0);
  const ContactState sheared = law.frictionless() ? ContactState::slip_forward : stick_or_slip(law, trial);
  if (state == ContactState::open)
    return trial.on_edge && trial.gap < -trial.tolerance ? sheared : ContactState::open;

  const double tension = trial.bonded ? law.tension : 0.0;
  const double pull = law.normal_stiffness * (trial.gap - trial.tolerance) - tension;
  const double shear = law.tangential_stiffness * std::abs(trial.slip);
  if (pull > 0 && !(state == ContactState::stick && is_slipping(sheared) && shear > pull))
    return ContactState::open;
  if (state == ContactState::stick || law.frictionless()) return sheared;
  const bool moved_back = slip_sign(state) * trial.slip_increment < -trial.tolerance;
  return moved_back && sheared != state ? ContactState::stick : state;
}

}  // namespace ddacontact
