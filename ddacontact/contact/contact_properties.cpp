#include <ddacontact/contact/contact_properties.hpp>

#include <ddacontact/contact/contact_positions.hpp>

#include <algorithm>

namespace ddacontact {

JointLaw ContactProperties::law(const ContactRecord& contact) const {
  const JointStrength& joint = strength(contact.pair);
  const bool glued = is_glued(contact) && contact.closed();
  const bool compliant = is_compliant(contact);
  const auto over = [&](double JointStrength::*stress) { return over_length(contact, stress); };
  return {.normal_stiffness = compliant ? over(&JointStrength::normal_stiffness) : normal_stiffness,
          .tangential_stiffness = compliant ? over(&JointStrength::shear_stiffness) : tangential_stiffness,
          .friction = friction_of(contact),
          .friction_law = joint.friction_law ? &joint.friction_law : nullptr,
          .cohesion = glued ? inf : over(&JointStrength::cohesion),
          .tension = glued ? inf : over(&JointStrength::tensile_strength),
          .compliant = compliant,
          .glued = glued,
          .ductile = joint.ductile || (beyond(contact) && beyond(contact)->ductile)};
}

const JointStrength* ContactProperties::beyond(const ContactRecord& contact) const {
  if (contact.history.length_beyond == 0) return nullptr;
  VertexEdge there = contact.pair;
  const auto n_edges = static_cast<int>(edge_joints[there.edge_block].size());
  there.edge = (there.edge + (contact.history.length_beyond > 0 ? 1 : n_edges - 1)) % n_edges;
  return &strength(there);
}

double ContactProperties::friction_of(const ContactRecord& contact) const {
  const auto friction = [&](const JointStrength& joint) {
    return contact.history.bonded ? joint.friction : joint.residual_friction.value_or(joint.friction);
  };
  const double here = friction(strength(contact.pair));
  const JointStrength* there = beyond(contact);
  if (!there) return here;
  const double part = part_beyond(contact);
  return (1 - part) * here + part * friction(*there);
}

double ContactProperties::inset(const ContactRecord& contact) const {
  const JointStrength& joint = strength(contact.pair);
  if (!joint.crushes()) return 0;
  return std::clamp(contact.history.normal / (2 * joint.compressive_strength), 0.0, contact.history.length);
}

void ContactProperties::add_forces(const BlockSystem& blocks, const BlockState& state,
                                   const ContactRecord& contact, VectorXd& F) const {
  const MovingVertexEdge motion = motion_of(blocks, state, contact.pair, inset(contact));
  const GapAndSlip rates = motion.rates_at_start(contact.history.lock);
  motion.form(rates.by_gap).add_gradient(contact.normal, F);
  motion.form(rates.by_slip).add_gradient(contact.shear, F);
}

}  // namespace ddacontact
