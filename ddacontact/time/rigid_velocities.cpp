#include <ddacontact/time/rigid_velocities.hpp>

#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/core/disjoint_sets.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/solver/friction_bounds.hpp>
#include <ddacontact/time/impulse_problem.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

namespace ddacontact {

namespace {

double dot(const NormalAndShear& a, const NormalAndShear& b) {
  return a.col(of_gap).dot(b.col(of_gap)) + a.col(of_slip).dot(b.col(of_slip));
}

/// Velocities of the blocks that the terms depend on, 0 for all others: those that supports give, and with
/// them the rigid motions of the blocks.
struct RigidPart {
  VectorXd driven, all;

  RigidPart(const BlockSystem& blocks, const BlockState& state, const RigidMotions& motions,
            const std::vector<ContactTerm>& terms, const VectorXd& v)
      : driven(VectorXd::Zero(v.size())), all(driven) {
    std::set<int> touched;
    for (const ContactTerm& term : terms)
      for (int u : term.gap.unknowns()) touched.insert(blocks.block_of_unknown(u));
    for (int b : touched) {
      const Block& block = blocks.block(b);
      const Range& u = block.unknowns();
      if (!blocks.is_movable(b))
        u.of(driven) = u.of(v);
      else if (!blocks.is_free(b))
        u.of(driven) = driven_motion(blocks, state, block, v);
    }
    all = driven;
    motions.add_motion(motions.coefficients(v - driven), all);
    for (int b : touched) {
      const Block& block = blocks.block(b);
      if (blocks.is_free(b))
        block.unknowns().of(all) = as_velocity(block, state, rigid_velocity(block, state, v));
    }
  }
};

std::vector<ContactTerm> rigid_terms(const RigidMotions& motions, std::vector<ContactTerm> terms) {
  for (ContactTerm& term : terms) {
    term.gap = motions.rate_form(term.gap);
    term.slip = motions.rate_form(term.slip);
  }
  return terms;
}

/// Contacts and the rigid motions of the blocks that they join. With G the gradients of the rates, impulses P
/// change the coefficients by w = G^T P, and the rates by G w.
struct Setting {
  RigidMotions motions;
  ImpulseProblem problem;
  NormalAndShear rates;         ///< before
  NormalAndShear rigid_rates;   ///< without those of deformation
  NormalAndShear driven_rates;  ///< of what supports give alone
  VectorXd driven;              ///< the coefficients of that

  /// \param[in] terms  forms of all unknowns
  /// \param[in] beside  rates that are not those of v
  Setting(const BlockSystem& blocks, const BlockState& state, const std::vector<int>& hit_blocks,
          const std::vector<ContactTerm>& terms, const VectorXd& v, const NormalAndShear& beside)
      : motions(blocks, state, hit_blocks),
        problem(motions, rigid_terms(motions, terms)),
        rates(rates_of(terms, v) + beside) {
    const RigidPart rigid(blocks, state, motions, terms, v);
    rigid_rates = rates_of(terms, rigid.all);
    driven_rates = rates_of(terms, rigid.driven);
    driven = motions.coefficients(rigid.driven);
  }

  /// What the impulses take from the kinetic energy and from what moves the supports: -P . (rates before and
  /// after) / 2. Rates of deformation have no part: no rigid motion has kinetic energy in common with them.
  double loss(const NormalAndShear& P) const {
    return -dot(P, rigid_rates) - problem.change(P).squaredNorm() / 2;
  }
  /// Whether impulses leave more than half of the approach that they act against: supports drive blocks
  /// together that cannot give way as rigid ones.
  bool stop_nothing(const NormalAndShear& P) const {
    const NormalAndShear after = rates + problem.change_of_rates(problem.change(P));
    const double before = P.col(of_gap).dot(rates.col(of_gap));
    return before < 0 && P.col(of_gap).dot(after.col(of_gap)) < before / 2;
  }
  /// The largest part of the way from a, whose loss must be >= 0, to b after which the loss still is.
  double largest_part(const NormalAndShear& a, const NormalAndShear& b) const {
    const NormalAndShear way = b - a;
    const VectorXd w_a = problem.change(a), w = problem.change(way);
    const double round_off =
        few_ulps * (dot(b.cwiseAbs(), rigid_rates.cwiseAbs()) + problem.change(b).squaredNorm());
    if (loss(b) >= -round_off) return 1;
    const double linear = dot(way, rigid_rates) + w.dot(w_a), constant = std::max(0., loss(a));
    const double root = std::sqrt(linear * linear + 2 * w.squaredNorm() * constant);
    return std::clamp((root - linear) / w.squaredNorm(), 0., 1.);
  }
  void finish(const NormalAndShear& P, JumpReport& report) const {
    const VectorXd w = problem.change(P);
    const NormalAndShear mean = rigid_rates + problem.change_of_rates(w) / 2;
    report.normal_loss = -P.col(of_gap).dot(mean.col(of_gap));
    report.friction_loss = -P.col(of_slip).dot(mean.col(of_slip));
    report.support_work = w.dot(driven) - dot(P, driven_rates);
    motions.add_motion(w, report.jump);
  }
};

/// What of an impact takes part in it.
struct Colliding {
  std::vector<int> blocks;            ///< that move, ascending
  std::vector<std::size_t> contacts;  ///< indices
  std::vector<ContactTerm> terms;
  std::vector<const ImpactContact*> laws;  ///< of friction; null: bonded
  NormalAndShear beside;                   ///< rates that are not those of the velocities
  VectorXd restitution;
  double approach = 0;  ///< the largest, m/s

  /// Of |P_T| under these normal impulses.
  VectorXd bounds(const VectorXd& under) const {
    VectorXd bounds(under.size());
    for (Index k = 0; k < under.size(); ++k)
      bounds[k] = laws[k] ? laws[k]->bound(std::max(0.0, under[k])) : 0;
    return bounds;
  }
};

ContactTerm impact_term(const ImpactContact& contact) {
  ContactTerm term{.gap = contact.gap, .slip = contact.slip};
  term.sheared = contact.bonded || contact.friction > 0 || contact.friction_law;
  if (contact.bonded) {
    term.normal = ContactTerm::Normal::bilateral;
    term.bound = inf;
  }
  return term;
}

/// Of the islands of movable blocks joined by contacts those in which one approaches.
Colliding find_colliding(const BlockSystem& blocks, const std::vector<ImpactContact>& contacts,
                         const VectorXd& v, double least_approach) {
  DisjointSets islands(blocks.n_blocks());
  std::vector<int> first_of(contacts.size(), -1);  // the first movable block of each contact, -1: none
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (int u : contacts[c].gap.unknowns()) {
      const int b = blocks.block_of_unknown(u);
      if (!blocks.is_movable(b)) continue;
      if (first_of[c] < 0) first_of[c] = b;
      islands.join(b, first_of[c]);
    }
  Colliding found;
  std::set<int> hit;  // roots
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const double approach = contacts[c].bonded ? 0 : -contacts[c].gap.change(v) - contacts[c].gap_rate;
    if (!(approach > least_approach)) continue;
    if (first_of[c] >= 0) hit.insert(islands.root(first_of[c]));
    found.approach = std::max(found.approach, approach);
  }
  for (int b = 0; b < blocks.n_blocks(); ++b)
    if (blocks.is_movable(b) && hit.contains(islands.root(b))) found.blocks.push_back(b);
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (first_of[c] >= 0 && hit.contains(islands.root(first_of[c]))) found.contacts.push_back(c);
  found.beside.resize(found.contacts.size(), 2);
  found.restitution.resize(found.beside.rows());
  for (std::size_t k = 0; k < found.contacts.size(); ++k) {
    const ImpactContact& contact = contacts[found.contacts[k]];
    found.terms.push_back(impact_term(contact));
    found.laws.push_back(contact.bonded ? nullptr : &contact);
    found.beside.row(k) << contact.gap_rate, contact.slip_rate;
    found.restitution[k] = contact.bonded ? 0 : contact.restitution;
  }
  return found;
}

/// Solves with friction, |P_T| <= bound(P_N + given), from impulses of zero. False: friction
/// and normal impulses do not agree, or rates do not vanish to the tolerance.
bool solve_with_friction(const NormalAndShear& rates, const Colliding& of, const VectorXd& given,
                         double tolerance, ImpulseProblem& problem) {
  bool vanish = false;
  const auto solve = [&](const VectorXd& bounds, VectorXd& wanted) {
    problem.set_bounds(bounds);
    vanish = problem.solve(rates, tolerance);
    wanted = of.bounds(problem.impulses().col(of_gap).cwiseMax(0) + given);
  };
  problem.forget_impulses();
  VectorXd bounds = of.bounds(given);
  return iterate_bounds(solve, bounds) && vanish;
}

}  // namespace

// What is lost is -P . (u + u') / 2 for rates u before and u' = u + G G^T P after. In compression
// u' . P <= 0, so that -P . u' + |G^T P|^2 / 2 >= 0 is lost. Of one common e without shear and second
// contact, u' . P = 0 there, and (1 + e) P leads to u' + e G G^T P: (1 + e) (1 - e) |G^T P|^2 / 2 >= 0 is
// lost. With several e, with shear, which gives nothing back, or with rates of deformation there is no such
// theorem: what would make energy is taken in part.
JumpReport impact(const BlockSystem& blocks, const BlockState& state,
                  const std::vector<ImpactContact>& contacts, const VectorXd& v, double least_approach) {
  assert(v.size() == blocks.n_unknowns() && least_approach >= 0);
  constexpr double vanishing = 1e-10;  // of the largest approach: rates that should vanish
  JumpReport report;
  report.jump = VectorXd::Zero(blocks.n_unknowns());
  report.impulses.resize(contacts.size());
  const Colliding of = find_colliding(blocks, contacts, v, least_approach);
  if (of.contacts.empty()) return report;

  Setting setting(blocks, state, of.blocks, of.terms, v, of.beside);
  ImpulseProblem& problem = setting.problem;
  const double tolerance = vanishing * of.approach;
  const NormalAndShear none = NormalAndShear::Zero(of.contacts.size(), 2);
  report.settled = solve_with_friction(setting.rates, of, none.col(of_gap), tolerance, problem);
  const NormalAndShear compression = problem.impulses();
  if (!report.settled && setting.stop_nothing(compression)) return report;  // left to their deformation
  const double compressed = setting.largest_part(none, compression);
  report.limited = compressed < 1;
  NormalAndShear total = compressed * compression;

  const VectorXd given = of.restitution.cwiseProduct(compression.col(of_gap));
  if (!report.limited && (given.array() > 0).any()) {
    NormalAndShear restored = compression;
    restored.col(of_gap) += given;
    const NormalAndShear rates = setting.rates + problem.change_of_rates(problem.change(restored));
    report.settled = solve_with_friction(rates, of, given, tolerance, problem) && report.settled;
    restored += problem.impulses();
    const double part = setting.largest_part(compression, restored);
    report.limited = part < 1;
    total = compression + part * (restored - compression);
  }
  const VectorXd bounds = of.bounds(total.col(of_gap));
  for (Index c = 0; c < given.size(); ++c)  // bounds agree to a tolerance: now exactly
    if (!std::isinf(of.terms[c].bound))
      total(c, of_slip) = std::clamp(total(c, of_slip), -bounds[c], bounds[c]);
  if (!report.settled) {
    const double part = setting.largest_part(none, total);
    report.limited = report.limited || part < 1;
    total *= part;
  }
  for (std::size_t k = 0; k < of.contacts.size(); ++k)
    report.impulses[of.contacts[k]] = {total(k, of_gap), total(k, of_slip)};
  setting.finish(total, report);
  return report;
}

}  // namespace ddacontact
