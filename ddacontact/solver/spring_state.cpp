#include <ddacontact/solver/spring_state.hpp>

#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool bears_shear(const ContactTerm& term, const JointLaw& law) {
  return term.sheared && (term.bound > 0 || law.has_friction());
}

}  // namespace

unsigned char first_state(const Contact& contact, bool sheared) {
  if (!contact.closed()) return open;
  if (!sheared) return pressed;
  const ContactHistory& history = contact.history;
  if (!is_slipping(history.state)) return pressed | stuck;
  const bool upper = history.shear > 0 || history.state == ContactState::slip_backward;
  return pressed | (upper ? at_upper : at_lower);
}

unsigned char state_at(const ContactTerm& term, const JointLaw& law, const ContactSprings& springs) {
  const auto& [n, t] = springs;
  if (!n.acts() && term.bound == 0) return open;
  const unsigned char closed = n.acts() ? pressed : open;
  if (!bears_shear(term, law)) return closed;
  return closed | (t.acts() ? stuck : t.force > 0 ? at_upper : at_lower);
}

unsigned char state_of(const ContactTerm& term, const JointLaw& law, bool bonded, const ContactForce& force) {
  if (term.normal == ContactTerm::Normal::absent) return open;
  const double bound = term.bound < infinity ? shear_bound(law, force.normal, bonded) : infinity;
  const bool is_pressed = term.normal == ContactTerm::Normal::bilateral || force.normal > -term.tension;
  if (!is_pressed && bound == 0) return open;
  const unsigned char closed = is_pressed ? pressed : open;
  if (!bears_shear(term, law)) return closed;
  return closed | (std::abs(force.shear) < bound ? stuck : force.shear > 0 ? at_upper : at_lower);
}

ContactForce force_in_state(const JointLaw& law, bool bonded, unsigned char state,
                            const ContactSprings& springs) {
  ContactForce force;
  const bool follows = (state & pressed) || springs.normal.low == -infinity;
  force.normal = follows ? springs.normal.force : springs.normal.low;
  if (state & stuck) force.shear = springs.tangential.force;
  const double bound =
      force.normal < 0 && !bonded ? law.friction * force.normal : shear_bound(law, force.normal, bonded);
  if (state & at_upper) force.shear = bound;
  if (state & at_lower) force.shear = -bound;
  return force;
}

unsigned char next_state(unsigned char state, unsigned char at_d) {
  const bool turns = ((state | at_d) & (at_upper | at_lower)) == (at_upper | at_lower);
  return turns ? static_cast<unsigned char>((at_d & pressed) | stuck) : at_d;
}

}  // namespace ddacontact
