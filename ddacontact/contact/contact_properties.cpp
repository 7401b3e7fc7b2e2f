#include <ddacontact/contact/contact_properties.hpp>

#include <ddacontact/contact/contact_positions.hpp>

#include <algorithm>
#include <limits>

namespace ddacontact {

JointLaw ContactProperties::law(const ContactRecord& contact) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const JointStrength& joint = strength(contact.pair);
  const bool glued = joint.glued && contact.closed();
  const bool compliant = is_compliant(contact);
  return {
      .normal_stiffness = compliant ? joint.normal_stiffness * contact.history.length : normal_stiffness,
      .tangential_stiffness =
          compliant ? joint.shear_stiffness * contact.history.length : tangential_stiffness,
      .friction = contact.history.bonded ? joint.friction : joint.residual_friction.value_or(joint.friction),
      .friction_law = joint.friction_law ? &joint.friction_law : nullptr,
      .cohesion = glued ? infinity : joint.cohesion * contact.history.length,
      .tension = glued ? infinity : joint.tensile_strength * contact.history.length,
      .compliant = compliant,
      .glued = glued,
      .ductile = joint.ductile};
}

double ContactProperties::inset(const ContactRecord& contact) const {
  const JointStrength& joint = strength(contact.pair);
  if (!joint.crushes()) return 0;
  return std::clamp(contact.history.normal / (2 * joint.compressive_strength), 0.0, contact.history.length);
}

void ContactProperties::add_forces(const BlockSystem& blocks, const BlockState& state,
                                   const ContactRecord& contact, VectorXd& F) const {
  const MovingVertexEdge motion = motion_of(blocks, state, contact.pair, inset(contact));
  const GapAndSlip rates = motion.rates_at(motion.positions(), contact.history.lock);
  motion.form(rates.by_gap).add_gradient(contact.normal, F);
  motion.form(rates.by_slip).add_gradient(contact.shear, F);
}

}  // namespace ddacontact
