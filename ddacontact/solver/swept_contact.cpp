#include <ddacontact/solver/swept_contact.hpp>

#include <cassert>
#include <cmath>

namespace ddacontact {

void SweptContact::set_law(const ContactTerm& term, const SweptLaw& own, const VectorXd& d) {
  assert(own.joint && term.normal_stiffness > 0 && term.tension >= 0);
  acts = term.normal != ContactTerm::Normal::absent;
  slides = !std::isinf(term.bound);
  tension = term.normal == ContactTerm::Normal::unilateral ? term.tension : inf;
  bonded = own.bonded;
  lets_go = tension < inf && slides && !bonded;
  sheared = term.sheared && (term.bound > 0 || own.joint->has_friction());
  own_law = bonded || own.joint->friction_law ? own.joint : nullptr;
  bound = {own.joint->friction, slides ? 0 : inf};
  normal_compliance = 1 / term.normal_stiffness;
  tangential_compliance = 1 / term.tangential_stiffness;
  gap = term.gap(d) - term.normal_multiplier * normal_compliance;
  slip = term.sheared ? term.slip(d) - own.shear * tangential_compliance : 0;
}

}  // namespace ddacontact
