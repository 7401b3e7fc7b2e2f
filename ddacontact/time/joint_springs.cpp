#include <ddacontact/time/joint_springs.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

double square(double x) {
  return x * x;
}

/// By springs under these forces.
double stored(const auto& force, double normal_stiffness, double shear_stiffness) {
  return square(force.normal) / (2 * normal_stiffness) + square(force.shear) / (2 * shear_stiffness);
}

}  // namespace

ContactForce end_forces_of_joint(const Contact& contact, bool means) {
  if (!contact.closed()) return {};
  const bool doubled = means && contact.history.state == ContactState::stick;
  const double strength = contact.has_bond() ? contact.law.tension : 0;  // a bond that yields bears no more
  return {std::max(-strength, contact.law.normal_stiffness * (contact.history.gap_offset - contact.gap)),
          doubled ? 2 * contact.shear - contact.history.shear : contact.shear};
}

double energy_of_joint(const ContactProperties& properties, const ContactRecord& contact) {
  if (!contact.closed()) return 0;
  return stored(contact.history, properties.over_length(contact, &JointStrength::normal_stiffness),
                properties.over_length(contact, &JointStrength::shear_stiffness));
}

double lost_by_joints(const ContactProperties& properties, const std::vector<ContactRecord>& before,
                      const std::vector<Contact>& contacts) {
  if (!properties.joints.any(&JointStrength::is_compliant)) return 0;
  double lost = 0;
  for (const ContactRecord& contact : before)
    if (properties.is_compliant(contact)) lost += energy_of_joint(properties, contact);
  for (const Contact& contact : contacts)
    if (contact.law.compliant)
      lost -= stored(contact.history, contact.law.normal_stiffness, contact.law.tangential_stiffness);
  return lost;
}

void account_joint_springs(const Contact& contact, bool means, Energy& energy) {
  const ContactForce end = end_forces_of_joint(contact, means);
  const double k = contact.law.normal_stiffness, k_s = contact.law.tangential_stiffness,
               by_dashpot = contact.normal == 0 ? 0 : contact.dashpot_force(contact.gap);
  // What of the slip is not the spring's is friction's.
  const double slid = contact.slip_change - (contact.history.shear - end.shear) / k_s,
               by_friction = -contact.shear * slid;
  energy.damping_dissipated -= by_dashpot * contact.gap_change;
  energy.friction_dissipated += by_friction;
  energy.numerical_dissipated += stored(contact.history, k, k_s) - stored(end, k, k_s) -
                                 (contact.normal - by_dashpot) * contact.gap_change -
                                 contact.shear * contact.slip_change - by_friction;
}

}  // namespace ddacontact
