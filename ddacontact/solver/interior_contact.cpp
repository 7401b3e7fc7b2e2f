#include <ddacontact/solver/interior_contact.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace ddacontact {

/// From the bounds of friction at the start, of sqrt(mu).
constexpr double least_distance = 1e-6;
/// A solution is followed to this part of the way to the nearest bound.
constexpr double part_to_bound = 0.99;

unsigned char InteriorContact::state(const SweptLaw& law) const {
  if (!acts) return none_acts;
  const bool is_open = unilateral && normal.x < normal.s;
  if (is_open && !law.bonded) return none_acts;
  const unsigned char closed = is_open ? none_acts : normal_acts;
  if (!sheared) return closed;
  if (holds) return closed | shear_acts;
  return closed | (upper.s > upper.x ? at_upper : lower.s > lower.x ? at_lower : shear_acts);
}

void InteriorContact::evaluate(const ContactTerm& term, const SweptLaw& law, const VectorXd& d, double mu) {
  const bool acted = std::exchange(acts, term.normal != ContactTerm::Normal::absent);
  p = term.normal_stiffness;
  p_t = term.tangential_stiffness;
  tension = term.normal == ContactTerm::Normal::unilateral ? term.tension : 0;
  a = term.normal_multiplier + tension - p * term.gap(d);
  if (sheared || term.sheared) slip = term.slip(d);
  if (acts && !acted) begin(term, law, mu);
  evaluate_friction(law);
}

void InteriorContact::evaluate_friction(const SweptLaw& law) {
  if (!acts || !sheared) return;
  b = shear_bound(*law.joint, N(), law.bonded);
  rate = friction_rate(*law.joint, N(), law.bonded);
  q = law.shear - p_t * slip;
}

void InteriorContact::begin(const ContactTerm& term, const SweptLaw& law, double mu) {
  unilateral = term.normal != ContactTerm::Normal::bilateral;
  holds = std::isinf(term.bound);
  sheared = term.sheared && (law.bonded || holds || law.joint->has_friction());
  const double half = a / 2, root = std::sqrt(half * half + mu);
  normal.begin(a > 0 ? half + root : mu / (root - half), mu);
  if (!unilateral) normal.x = a;
  evaluate_friction(law);
  if (holds) T = q;
  if (!slides()) return;
  const double size = std::abs(q) + b, least = least_distance * std::sqrt(mu);
  T = b == 0 ? 0 : b * q / size;
  upper.begin(std::max(b - T, least), mu);
  lower.begin(std::max(b + T, least), mu);
}

void InteriorContact::find_rates() {
  assert(acts && p > 0 && rate >= 0);
  const double f = slides() ? upper.s / upper.x : 0, k = slides() ? lower.s / lower.x : 0;
  w = unilateral ? normal.x / (normal.x + normal.s) : 1;
  wt = sheared ? 1 / (1 + f + k) : 0;
  mixed = slides() ? wt * (f - k) : 0;
}

void InteriorContact::aim(double mu, double second_order) {
  for_pairs([&](InteriorPair& pair) { pair.aim(mu, second_order); });
  cN = w * (a - normal.x + (unilateral ? normal.target / normal.x : 0));
  cT = q - T;
  if (slides())
    cT += (lower.target + lower.s * lower_error()) / lower.x -
          (upper.target + upper.s * upper_error()) / upper.x;
  cT *= wt;
}

void InteriorContact::follow(double gap_change, double slip_change) {
  const double dN = w * (p * gap_change) + cN;
  normal.dx = dN;
  if (unilateral) normal.follow(dN);
  if (!sheared) return;
  dT = wt * (p_t * slip_change) + mixed * rate * dN + cT;
  if (holds) return;
  upper.follow(rate * dN - dT - upper_error());
  lower.follow(rate * dN + dT - lower_error());
}

double InteriorContact::longest() {
  double length = 1;
  const auto shorten = [&](double x, double dx) {
    if (dx < 0) length = std::min(length, -part_to_bound * x / dx);
  };
  for_pairs([&](const InteriorPair& pair) {
    shorten(pair.x, pair.dx);
    shorten(pair.s, pair.ds);
  });
  return length;
}

void InteriorContact::advance(double length) {
  for_pairs([&](InteriorPair& pair) {
    pair.x += length * pair.dx;
    pair.s += length * pair.ds;
    assert(!(pair.x < 0) && !(pair.s < 0));
  });
  if (!acts) return;
  if (!unilateral) normal.x += length * normal.dx;
  if (sheared) T += length * dT;
}

}  // namespace ddacontact
