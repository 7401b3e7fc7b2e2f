#include <ddacontact/solver/relaxation.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr int most_sweeps = 40;
/// Sweeps in a row in which no more than this part of the contacts changes its state.
constexpr int quiet_sweeps = 3;
constexpr double still_changing = 1e-3;

/// Which of the law's cases a force is.
int piece(const ContactForce& force, double bound) {
  return force.normal == 0 ? 0 : force.shear >= bound ? 1 : force.shear <= -bound ? 2 : 3;
}

/// Forces of one contact while those of the others stay: the gap and the slip without them are g and s, and W
/// what they add.
struct LocalProblem {
  double g, s;              ///< without the contact's own forces
  double wnn, wnt, wtt;     ///< what these change
  const ContactTerm& term;  ///< stiffnesses and the normal multiplier
  const RelaxedLaw& law;

  ContactForce solve(const ContactForce& before) const {
    const double an = 1 / term.normal_stiffness + wnn,
                 rn = term.normal_multiplier / term.normal_stiffness - g;
    const bool unilateral = term.normal == ContactTerm::Normal::unilateral;
    if (!term.sheared || (term.bound == 0 && !law.joint->has_friction()))
      return {unilateral ? std::max(0.0, rn / an) : rn / an, 0};
    const bool bonded = std::isinf(term.bound);
    const double bound_before =
        bonded ? term.bound : shear_bound(*law.joint, std::max(0.0, before.normal), false);
    const double multiplier = law.sliding && !bonded ? std::copysign(bound_before, law.shear)
                                                     : std::clamp(law.shear, -bound_before, bound_before);
    const double at = 1 / term.tangential_stiffness + wtt, rt = multiplier / term.tangential_stiffness - s;
    const double determinant = an * at - wnt * wnt;
    const ContactForce stuck{(rn * at - rt * wnt) / determinant, (rt * an - rn * wnt) / determinant};
    if (bonded && !(unilateral && stuck.normal < 0)) return stuck;
    if (stuck.normal <= 0) return {unilateral ? std::max(0.0, rn / an) : rn / an, 0};
    const double bound = shear_bound(*law.joint, stuck.normal, false);
    if (std::abs(stuck.shear) <= bound) return stuck;
    // N with T = +- bound(N), the bound linear from here.
    const double sense = stuck.shear > 0 ? 1 : -1, rate = sense * bound / stuck.normal;
    const double normal = std::max(0.0, rn / (an + rate * wnt));
    return {normal, sense * shear_bound(*law.joint, normal, false)};
  }
};

}  // namespace

bool ContactRelaxation::set_matrices(FrictionProblem& problem) {
  problem_ = &problem;
  return inverse_.set_matrices(problem) && inverse_.invert();
}

void ContactRelaxation::set_contact(const ContactTerm& term, Local& local) const {
  local = {};
  for (Answer& answer : local.answers) {
    answer.of_normal.fill(0);
    answer.of_shear.fill(0);
  }
  const std::span<const int> unknowns = term.gap.unknowns();
  const auto each = [&](auto&& visit) {
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
      const int u = unknowns[k], block = inverse_.block_of(u);
      if (block >= 0)
        visit(block, inverse_.place_in_block(u), term.gap.coefficients()[k],
              term.sheared ? term.slip.coefficients()[k] : 0.0);
    }
  };
  each([&](int block, int place, double normal, double shear) {
    Answer& answer = local.answers[local.answers[0].block < 0 || local.answers[0].block == block ? 0 : 1];
    answer.block = block;
    const auto inverse = inverse_.inverse(block);
    for (Index k = 0; k < inverse.rows(); ++k) {
      answer.of_normal[static_cast<std::size_t>(k)] += inverse(k, place) * normal;
      answer.of_shear[static_cast<std::size_t>(k)] += inverse(k, place) * shear;
    }
  });
  each([&](int block, int place, double normal, double shear) {
    const Answer& answer = local.answers[local.answers[0].block == block ? 0 : 1];
    const std::size_t k = static_cast<std::size_t>(place);
    local.normal += normal * answer.of_normal[k];
    local.mixed += normal * answer.of_shear[k];
    local.shear += shear * answer.of_shear[k];
  });
}

void ContactRelaxation::move(const Answer& answer, double normal, double shear, VectorXd& d) const {
  if (answer.block < 0) return;
  const std::span<const int> unknowns = problem_->unknowns().rows_of(answer.block);
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    d[unknowns[k]] += answer.of_normal[k] * normal + answer.of_shear[k] * shear;
}

int ContactRelaxation::relax(const std::vector<ContactTerm>& terms, const std::vector<RelaxedLaw>& laws,
                             const VectorXd& residual, VectorXd& d, std::vector<ContactForce>& forces) {
  const std::size_t n = terms.size();
  locals_.resize(n);
  for (std::size_t c = 0; c < n; ++c) set_contact(terms[c], locals_[c]);
  VectorXd correction;
  inverse_.apply(residual, correction);
  d -= correction;

  int quiet = 0, sweep = 0;
  while (sweep < most_sweeps && quiet < quiet_sweeps) {
    std::size_t n_changed = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t c = sweep % 2 == 0 ? k : n - 1 - k;
      const ContactTerm& term = terms[c];
      if (term.normal == ContactTerm::Normal::absent) continue;
      const Local& local = locals_[c];
      const ContactForce before = forces[c];
      const LocalProblem problem{
          term.gap(d) - local.normal * before.normal - local.mixed * before.shear,
          (term.sheared ? term.slip(d) : 0) - local.mixed * before.normal - local.shear * before.shear,
          local.normal,
          local.mixed,
          local.shear,
          term,
          laws[c]};
      const ContactForce after = problem.solve(before);
      forces[c] = after;
      for (const Answer& answer : local.answers)
        move(answer, after.normal - before.normal, after.shear - before.shear, d);
      const auto piece_of = [&](const ContactForce& force) {
        return piece(force, std::isinf(term.bound)
                                ? term.bound
                                : shear_bound(*laws[c].joint, std::max(0.0, force.normal), false));
      };
      if (piece_of(before) != piece_of(after)) ++n_changed;
    }
    ++sweep;
    quiet = static_cast<double>(n_changed) <= still_changing * static_cast<double>(n) ? quiet + 1 : 0;
  }
  return sweep;
}

}  // namespace ddacontact
