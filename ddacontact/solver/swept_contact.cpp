#include <ddacontact/solver/swept_contact.hpp>

#include <cassert>
#include <cmath>

namespace ddacontact {

void SweptContact::set_law(const ContactTerm& term, const SweptLaw& own, const VectorXd& d) {
  assert(own.joint && term.normal_stiffness > 0 && term.tension >= 0);
  law = own;
  acts = term.normal != ContactTerm::Normal::absent;
  slides = !std::isinf(term.bound);
  tension = term.normal == ContactTerm::Normal::unilateral ? term.tension : inf;
  lets_go = tension < inf && slides && !law.bonded;
  sheared = term.sheared && (term.bound > 0 || law.joint->has_friction());
  has_own_law = law.joint->friction_law;
  bound = {law.joint->friction, !slides ? inf : law.bonded ? law.joint->cohesion : 0};
  normal_compliance = 1 / term.normal_stiffness;
  tangential_compliance = 1 / term.tangential_stiffness;
  gap = term.gap(d) - term.normal_multiplier * normal_compliance;
  slip = term.sheared ? term.slip(d) : 0;
}

}  // namespace ddacontact
