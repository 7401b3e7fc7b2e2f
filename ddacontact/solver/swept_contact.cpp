#include <ddacontact/solver/swept_contact.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

void SweptContact::set_law(const ContactTerm& term, const SweptLaw& own, const VectorXd& d) {
  assert(own.joint && term.normal_stiffness > 0 && term.tension >= 0);
  law = own;
  acts = term.normal != ContactTerm::Normal::absent;
  unilateral = term.normal == ContactTerm::Normal::unilateral;
  slides = !std::isinf(term.bound);
  tension = term.tension;
  sheared = term.sheared && (term.bound > 0 || law.joint->has_friction());
  normal_compliance = 1 / term.normal_stiffness;
  tangential_compliance = 1 / term.tangential_stiffness;
  gap = term.gap(d) - term.normal_multiplier * normal_compliance;
  slip = term.sheared ? term.slip(d) : 0;
}

double SweptContact::bound_under(double N) const {
  return slides ? shear_bound(*law.joint, N, law.bonded) : inf;
}

ContactForce SweptContact::solve(double gap_without, double slip_without) const {
  const double an = normal_compliance + normal, rn = -gap_without, least = unilateral ? -tension : -inf;
  assert(an > 0);
  const ContactForce closed{std::max(least, rn / an), 0};
  if (!sheared) return closed;
  const double bound_before = bound_under(force.normal);
  const double multiplier = law.sliding && slides ? std::copysign(bound_before, law.shear)
                                                  : std::clamp(law.shear, -bound_before, bound_before);
  const double at = tangential_compliance + shear, rt = multiplier * tangential_compliance - slip_without;
  const double determinant = an * at - mixed * mixed;
  assert(at > 0 && determinant > 0);
  const ContactForce stick{(rn * at - rt * mixed) / determinant, (rt * an - rn * mixed) / determinant};
  if (stick.normal > least && std::abs(stick.shear) <= bound_under(stick.normal)) return stick;
  // Where friction that sticks would pull the contact open it slides under what presses without it; a bond
  // that is pulled open bears shear.
  const double near = stick.normal > least ? stick.normal : closed.normal;
  if (near <= least || !slides) {
    const double most = bound_under(least);
    return {least, std::clamp((rt - mixed * least) / at, -most, most)};
  }
  // N with T = +- bound(N), the bound linear from there.
  const double sense = stick.shear > 0 ? 1 : -1, most = bound_under(near),
               rate = sense * friction_rate(*law.joint, near, law.bonded);
  const double N = std::max(least, (rn - mixed * (sense * most - rate * near)) / (an + rate * mixed));
  return {N, sense * bound_under(N)};
}

}  // namespace ddacontact
