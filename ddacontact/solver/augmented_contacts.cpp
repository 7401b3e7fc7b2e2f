#include <ddacontact/solver/augmented_contacts.hpp>

#include <ddacontact/core/for_all.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

/// A contact is so much stiffer than the compliant side of it: at least, for augmentations to converge by a
/// tenth, and at most, for its round-off to stay below the forces that the compliant side bears.
constexpr double least_stiffness_ratio = 10, largest_stiffness_ratio = 1000;
/// A dynamic step corrects this part of the gaps and slips of closed contacts, and all beyond the penetration
/// tolerance. Schemes that damp nothing correct the latter alone, since forces that follow the sum of past
/// gaps drive vibrations: their contacts are stiffer by what corrections would add up to.
constexpr double corrected_part = 0.2;
/// Forces that they have raised beyond the tolerance fall along the spring through the force and the gap
/// reached: at other gaps than they rose at, cycles of loading would do work. Gaps below this part of the
/// tolerance tell nothing of that spring.
constexpr double least_raised = 0.01;

/// Complementarity: no tension beyond a bond's, no shear beyond the bound, up to half the digits and
/// `negligible`, N per m.
[[maybe_unused]] bool is_admissible(const JointLaw& law, bool bonded, const ContactForce& force,
                                    double negligible) {
  constexpr double half_the_digits = std::numeric_limits<float>::epsilon();
  const double bound = shear_bound(law, force.normal, bonded),
               allowed = negligible + half_the_digits * (std::abs(force.normal) + std::abs(force.shear));
  return std::isfinite(allowed) && force.normal >= -(bonded ? law.tension : 0) - allowed &&
         (law.glued || std::abs(force.shear) <= bound + allowed);
}

}  // namespace

AugmentedContacts::AugmentedContacts(const StepProblem& system, const ContactSolverOptions& options,
                                     std::vector<Contact>& contacts)
    : system_(system),
      options_(options),
      contacts_(contacts),
      multipliers_(contacts.size()),
      terms_(contacts.size()),
      springs_(contacts.size()),
      law_states_(contacts.size()),
      forces_(contacts.size()) {}

void AugmentedContacts::begin() {
  for_all(contacts_.size(), [&](std::size_t c) { begin(contacts_[c], multipliers_[c]); });
}

void AugmentedContacts::begin(Contact& contact, Multiplier& multiplier) const {
  assert(contact.law.normal_stiffness > 0 && contact.law.tangential_stiffness > 0);
  JointLaw& law = contact.law;
  const ContactHistory& history = contact.history;
  multiplier.bonded = contact.has_bond();
  multiplier.acts = contact.meets || multiplier.bonded || contact.closed();
  contact.was_closed = contact.closed();
  if (law.compliant) return begin_compliant(contact, multiplier);
  if (options_.penetration_tolerance == 0) return;
  const double ratio = law.tangential_stiffness / law.normal_stiffness,
               lower_stiffness = system_.contact_stiffness(contact);
  if (leaves_gaps()) law.normal_stiffness /= corrected_part;
  if (std::isfinite(lower_stiffness))
    law.normal_stiffness = std::clamp(law.normal_stiffness, least_stiffness_ratio * lower_stiffness,
                                      largest_stiffness_ratio * lower_stiffness);
  const double start_gap = contact.first_gap().constant - history.gap_offset, force = history.normal,
               least_gap = least_raised * options_.penetration_tolerance * contact.size;
  if (leaves_gaps() && contact.closed() && force * start_gap < 0 &&
      std::abs(force) > law.normal_stiffness * (std::abs(start_gap) + least_gap))
    law.normal_stiffness = std::abs(force) / std::max(std::abs(start_gap), least_gap);
  law.tangential_stiffness = ratio * law.normal_stiffness;
  if (!contact.closed()) return;
  multiplier.normal = history.normal + law.normal_stiffness * kept(start_gap, history.halvings, contact.size);
  multiplier.shear = history.shear;
  if (!is_slipping(history.state) && (law.has_friction() || multiplier.bonded))
    multiplier.shear += law.tangential_stiffness * kept(contact.first_slip().constant, 0, contact.size);
}

/// The joint's own springs: forces of the end of the step, or the means of both ends.
void AugmentedContacts::begin_compliant(const Contact& contact, Multiplier& multiplier) const {
  if (!contact.closed()) return;
  multiplier.shear = contact.history.shear + shear_stiffness(contact.law) * contact.first_slip().constant;
  if (!has_means()) return;
  multiplier.normal = contact.history.normal / 2;
}

/// What a step leaves of the gap or slip that a closed contact of blocks of this size starts with.
double AugmentedContacts::kept(double length, int halvings, double size) const {
  const double most = options_.penetration_tolerance * size, least = negligible_gap * most,
               within = std::min(std::abs(length), most), of_motion = leaves_gaps() ? 0 : corrected_part,
               part = options_.is_static ? std::ldexp(1, -halvings) : of_motion;
  return std::copysign(within <= least ? within : std::max(least, (1 - part) * within), length);
}

bool AugmentedContacts::add_met(VectorXd& d) {
  bool any = false;
  for (std::size_t c = 0; c < size(); ++c) {
    if (multipliers_[c].acts || contacts_[c].leaves || terms_[c].gap(d) >= 0 ||
        !contacts_[c].is_on_edge(terms_[c].slip(d)))
      continue;
    multipliers_[c].acts = true;
    any = true;
  }
  if (any) evaluate(d);
  return any;
}

void AugmentedContacts::take_first_forces() {
  for (std::size_t c = 0; c < size(); ++c) {
    const Contact& contact = contacts_[c];
    if (options_.warm_start)
      forces_[c] = {contact.normal, contact.shear};
    else if (contact.closed())
      forces_[c] = {contact.history.normal, contact.history.shear};
  }
}

void AugmentedContacts::evaluate(VectorXd& d) {
  const VectorXd displaced = system_.displacement(d);
  for_all(contacts_.size(),
          [&](std::size_t c) { evaluate(contacts_[c], displaced, d, multipliers_[c], terms_[c]); });
}

void AugmentedContacts::evaluate(const Contact& contact, const VectorXd& displaced, const VectorXd& d,
                                 Multiplier& multiplier, ContactTerm& term) const {
  const MovingVertexEdge& m = contact.motion;
  const auto [g, s, dg, ds] = m.gap_and_slip_at(displaced, contact.history.lock, options_.directions);
  term.gap = m.linear_form(g, dg, d);
  term.slip = m.linear_form(s, ds, d);
  multiplier.gap = term.gap.constant;
  term.gap.constant -= contact.history.gap_offset;

  const JointLaw& law = contact.law;
  term.normal_stiffness =
      law.normal_stiffness * (law.compliant && has_means() ? 1. / 2 : 1) + contact.damping;
  term.tangential_stiffness = shear_stiffness(law);
  term.normal_multiplier = multiplier.normal + contact.dashpot_force(contact.history.gap_offset);
  term.tension = multiplier.bonded ? law.tension : 0;
  term.normal = !multiplier.acts     ? ContactTerm::Normal::absent
                : term.tension < inf ? ContactTerm::Normal::unilateral
                                     : ContactTerm::Normal::bilateral;
  term.sheared = multiplier.bonded || law.has_friction() || !options_.skip.friction_rows;
  term.bound = shear_bound(law, normal_spring(term, d).clipped(), multiplier.bonded);
  term.tangential_multiplier = multiplier.shear;
}

void AugmentedContacts::find_springs(const VectorXd& d) {
  for_all(contacts_.size(), [&](std::size_t c) {
    springs_[c] = springs_at(terms_[c], d);
    law_states_[c] = state_at(terms_[c], contacts_[c].law, springs_[c]);
  });
}

void AugmentedContacts::take_states_of_forces() {
  for (std::size_t c = 0; c < size(); ++c)
    law_states_[c] = state_of(terms_[c], contacts_[c].law, multipliers_[c].bonded, forces_[c]);
}

void AugmentedContacts::raise_multipliers(const VectorXd& d) {
  for (std::size_t c = 0; c < size(); ++c) {
    if (contacts_[c].law.compliant) continue;
    Multiplier& multiplier = multipliers_[c];
    const double left = leaves_gaps() ? options_.penetration_tolerance * contacts_[c].size / 2 : 0;
    multiplier.normal = elastic_normal(c, d);
    if (springs_[c].normal.acts())
      multiplier.normal += contacts_[c].law.normal_stiffness * std::clamp(terms_[c].gap(d), -left, left);
    multiplier.shear = forces_[c].shear;
  }
}

/// N without the dashpot's part.
double AugmentedContacts::elastic_normal(std::size_t c, const VectorXd& d) const {
  return forces_[c].normal - (springs_[c].normal.acts() ? contacts_[c].dashpot_force(gap_at(c, d)) : 0);
}

bool AugmentedContacts::are_close(const VectorXd& d, double tolerances, int& worst) const {
  double furthest = 1;
  worst = -1;
  if (options_.penetration_tolerance == 0) return true;
  for (std::size_t c = 0; c < size(); ++c) {
    if (contacts_[c].law.compliant) continue;
    const double tolerance = tolerances * options_.penetration_tolerance * contacts_[c].size;
    double error = springs_[c].normal.acts() ? std::abs(terms_[c].gap(d)) : 0;
    if (springs_[c].tangential.acts() && forces_[c].shear != 0)
      error = std::max(error, std::abs(terms_[c].slip(d)));
    if (error > furthest * tolerance) {
      furthest = error / tolerance;
      worst = static_cast<int>(c);
    }
  }
  return worst < 0;
}

bool AugmentedContacts::hardly_penetrates(std::size_t c, const VectorXd& d) const {
  return !contacts_[c].law.compliant &&
         terms_[c].gap(d) >= -negligible_gap * options_.penetration_tolerance * contacts_[c].size;
}

bool AugmentedContacts::yields(std::size_t c, const VectorXd& d) const {
  if (!multipliers_[c].bonded) return false;
  const bool opens = !(law_states_[c] & normal_acts) && terms_[c].gap(d) > contacts_[c].length_tolerance();
  return opens || (is_sliding(c) && !contacts_[c].law.ductile);
}

bool AugmentedContacts::break_bonds(const VectorXd& d) {
  bool any = false;
  for (std::size_t c = 0; c < size(); ++c) {
    if (!yields(c, d)) continue;
    contacts_[c].history.bonded = multipliers_[c].bonded = false;
    any = true;
  }
  return any;
}

void AugmentedContacts::settle([[maybe_unused]] double negligible) {
  for (std::size_t c = 0; c < size(); ++c) {
    Contact& contact = contacts_[c];
    const bool bonded = multipliers_[c].bonded;
    assert(is_admissible(contact.law, bonded, forces_[c], negligible));
    const bool closed = forces_[c].normal > 0 || (bonded && contact.closed());
    contact.history.state = !closed                                  ? ContactState::open
                            : !contact.law.has_friction() && !bonded ? ContactState::slip_forward
                            : !is_sliding(c)                         ? ContactState::stick
                            : forces_[c].shear < 0                   ? ContactState::slip_forward
                                                                     : ContactState::slip_backward;
    contact.was_closed = contact.was_closed || closed;
    contact.normal = forces_[c].normal;
    contact.shear = forces_[c].shear;
  }
}

void AugmentedContacts::end(const VectorXd& d) {
  for_all(contacts_.size(), [&](std::size_t c) {
    contacts_[c].gap = gap_at(c, d);
    contacts_[c].gap_change = terms_[c].gap.change(d);
    contacts_[c].slip_change = terms_[c].slip.change(d);
    contacts_[c].end_slip = terms_[c].slip(d);
  });
}

std::vector<SweptLaw> AugmentedContacts::laws() const {
  std::vector<SweptLaw> laws(size());
  for (std::size_t c = 0; c < size(); ++c) {
    const Multiplier& m = multipliers_[c];
    const VertexEdge& pair = contacts_[c].pair;
    laws[c] = {&contacts_[c].law, m.shear, m.bonded,
               std::min(system_.sum_of_forces(pair.vertex_block), system_.sum_of_forces(pair.edge_block)),
               options_.penetration_tolerance * contacts_[c].size};
  }
  return laws;
}

std::vector<Coupling> AugmentedContacts::couplings(const std::vector<unsigned char>& states) const {
  std::vector<Coupling> couplings;
  for (std::size_t c = 0; c < size(); ++c) {
    const int sense = states[c] & at_upper ? 1 : states[c] & at_lower ? -1 : 0;
    const double rate = friction_rate(contacts_[c].law, forces_[c].normal, multipliers_[c].bonded) *
                        terms_[c].normal_stiffness;
    if (sense != 0 && rate != 0) couplings.push_back({c, sense * rate});
  }
  return couplings;
}

}  // namespace ddacontact
