#include <ddacontact/time/contact_histories.hpp>

#include <ddacontact/contact/contact_positions.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/time/joint_springs.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

/// A contact that slides rises. Out of a step that its corner has passed: of the height to which joints are flush
/// over what is near a corner. By dilation: the gap that counts as none grows with what of its slip is not its
/// spring's.
void rise(const ContactProperties& properties, double shear_before, Contact& contact, Energy& energy) {
  const JointStrength& joint = properties.strength(contact.pair);
  double& offset = contact.history.gap_offset;
  if (offset < 0 && properties.lip < inf && !contact.law.compliant && !joint.crushes())
    offset = std::min(0.0, offset + properties.lip / near_corner * std::abs(contact.slip_change));
  const double most = joint.dilation * joint.dilation_slip;
  if (offset >= most) return;
  const double elastic =
      contact.law.compliant ? (shear_before - contact.history.shear) / contact.law.tangential_stiffness : 0;
  const double lift = std::min(joint.dilation * std::abs(contact.slip_change - elastic), most - offset);
  offset += lift;
  // The next step rises by it, and books the work of that as the scheme's.
  energy.friction_dissipated -= contact.normal * lift;
  energy.numerical_dissipated += contact.normal * lift;
}

/// Forces that the next step begins with.
void hand_on_forces(bool hands_on, bool means, Contact& contact) {
  const double by_dashpot = contact.normal == 0 ? 0 : contact.dashpot_force(contact.gap);
  const ContactForce end = !hands_on               ? ContactForce{}
                           : contact.law.compliant ? end_forces_of_joint(contact, means)
                                                   : ContactForce{contact.normal - by_dashpot, contact.shear};
  contact.history.normal = end.normal;
  contact.history.shear = end.shear;
}

/// A static correction after which nothing has changed is halved the next time, one that has helped doubled
/// again: contacts of one corner may ask for what cannot be, and each correction adds to their forces.
void adapt_correction(double penetration_tolerance, Contact& contact) {
  constexpr int most = std::numeric_limits<float>::digits;
  constexpr double least_change = 0.05;  // of the whole correction: gaps of a wall follow each other slowly
  if (contact.law.compliant || contact.start_state == ContactState::open) return;
  ContactHistory& history = contact.history;
  const double before = contact.motion.start_gap() - history.gap_offset, after = contact.end_gap,
               least = negligible_gap * penetration_tolerance * contact.size,
               correction =
                   std::min(std::abs(before) - least, std::ldexp(std::abs(before), -history.halvings));
  if (correction <= 0) return;
  const bool changes = std::abs(before) - std::abs(after) >= correction / 2 ||
                       std::abs(after - before) >= least_change * std::ldexp(correction, history.halvings);
  history.halvings = static_cast<std::uint8_t>(changes ? std::max(history.halvings - 1, 0)
                                                       : std::min(history.halvings + 1, most));
}

}  // namespace

ContactEnds end_histories(const BlockSystem& blocks, const BlockState& next, const StepRule& rule,
                          const ContactProperties& properties, std::vector<Contact>& contacts,
                          Energy& energy) {
  ContactEnds ends;
  for (Contact& contact : contacts) {
    ContactHistory& history = contact.history;
    contact.end_gap = contact.gap - history.gap_offset;
    contact.since_asked += static_cast<float>(std::abs(contact.slip_change));
    if (rule.starts_at_rest) adapt_correction(properties.penetration_tolerance, contact);
    const ContactRecord before = contact;
    hand_on_forces(contact.closed() && (properties.has_multipliers() || contact.law.compliant),
                   rule.mean_forces(), contact);
    if (properties.strength(contact.pair).crushes()) {
      // Where a block turns, a place that follows its force at once makes it alternate in short steps.
      if (contact.closed() && rule.has_half_steps() && !rule.starts_at_rest)
        history.normal = (before.history.normal + history.normal) / 2;
      // The force moves along the face, and the gap that counts as none with it: nothing falls by that, which
      // takes longer than a short step.
      const auto gap_of = [&](const ContactRecord& at) {
        return motion_of(blocks, next, at.pair, properties.inset(at)).start_gap();
      };
      history.gap_offset += gap_of(contact) - gap_of(before);
    }
    if (is_slipping(history.state)) rise(properties, before.history.shear, contact, energy);
    const bool slid = is_slipping(history.state) && !contact.law.frictionless() && !contact.law.ductile;
    if (slid || !contact.closed()) history.bonded = false;
    assert(std::isfinite(history.normal) && std::isfinite(history.shear) &&
           std::isfinite(history.gap_offset));
    const bool had_strength = contact.law.cohesion > 0 || contact.law.tension > 0;
    if (contact.start_bonded && !history.bonded && had_strength) ++ends.broken_bonds;
    if (!contact.closed()) {
      if (std::abs(history.gap_offset) <= contact.length_tolerance()) history.gap_offset = 0;
      continue;
    }
    ++ends.closed;
    ends.deepest = std::max(ends.deepest, -contact.end_gap);
  }
  return ends;
}

}  // namespace ddacontact
