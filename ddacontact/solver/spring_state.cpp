#include <ddacontact/solver/spring_state.hpp>

#include <cmath>

namespace ddacontact {

namespace {

bool bears_shear(const ContactTerm& term, const JointLaw& law) {
  return term.sheared && (term.bound > 0 || law.has_friction());
}

}  // namespace

unsigned char first_state(const Contact& contact, bool sheared) {
  if (!contact.closed()) return none_acts;
  if (!sheared) return normal_acts;
  const ContactHistory& history = contact.history;
  if (!is_slipping(history.state)) return all_act;
  const bool upper = history.shear > 0 || history.state == ContactState::slip_backward;
  return normal_acts | (upper ? at_upper : at_lower);
}

unsigned char state_at(const ContactTerm& term, const JointLaw& law, const ContactSprings& springs) {
  const auto& [n, t] = springs;
  if (!n.acts() && term.bound == 0) return none_acts;
  const unsigned char closed = n.acts() ? normal_acts : none_acts;
  if (!bears_shear(term, law)) return closed;
  return closed | (t.acts() ? shear_acts : t.force > 0 ? at_upper : at_lower);
}

unsigned char state_of(const ContactTerm& term, const JointLaw& law, bool bonded, const ContactForce& force) {
  if (term.normal == ContactTerm::Normal::absent) return none_acts;
  const double bound = term.bound < inf ? shear_bound(law, force.normal, bonded) : inf;
  const bool is_closed = term.normal == ContactTerm::Normal::bilateral || force.normal > -term.tension;
  if (!is_closed && bound == 0) return none_acts;
  const unsigned char closed = is_closed ? normal_acts : none_acts;
  if (!bears_shear(term, law)) return closed;
  return closed | (std::abs(force.shear) < bound ? shear_acts : force.shear > 0 ? at_upper : at_lower);
}

ContactForce force_in_state(const JointLaw& law, bool bonded, unsigned char state,
                            const ContactSprings& springs) {
  ContactForce force;
  const bool follows = (state & normal_acts) || springs.normal.low == -inf;
  force.normal = follows ? springs.normal.force : springs.normal.low;
  if (state & shear_acts) force.shear = springs.tangential.force;
  const double bound = extended_bound(law, force.normal, bonded);
  if (state & at_upper) force.shear = bound;
  if (state & at_lower) force.shear = -bound;
  return force;
}

unsigned char next_state(unsigned char state, unsigned char at_d) {
  const bool turns = ((state | at_d) & (at_upper | at_lower)) == (at_upper | at_lower);
  return turns ? static_cast<unsigned char>((at_d & normal_acts) | shear_acts) : at_d;
}

}  // namespace ddacontact
