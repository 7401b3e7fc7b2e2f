#include <ddacontact/time/rigid_velocities.hpp>

#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/solver/friction_bounds.hpp>
#include <ddacontact/time/impulse_problem.hpp>
#include <ddacontact/time/islands.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace ddacontact {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

NormalAndShear zeros(Index n) {
  return {VectorXd::Zero(n), VectorXd::Zero(n)};
}
/// a + part (b - a)
NormalAndShear between(const NormalAndShear& a, const NormalAndShear& b, double part) {
  return {a.normal + part * (b.normal - a.normal), a.shear + part * (b.shear - a.shear)};
}
double dot(const NormalAndShear& a, const NormalAndShear& b) {
  return a.normal.dot(b.normal) + a.shear.dot(b.shear);
}

NormalAndShear rates_of(const std::vector<ContactTerm>& terms, const VectorXd& v) {
  NormalAndShear rates = zeros(static_cast<Index>(terms.size()));
  for (std::size_t c = 0; c < terms.size(); ++c) {
    rates.normal[static_cast<Index>(c)] = terms[c].gap.change(v);
    rates.shear[static_cast<Index>(c)] = terms[c].slip.change(v);
  }
  return rates;
}

/// The rigid motions in the velocities of the blocks that the terms depend on; 0 for all others. Of a block
/// that is held in part those that its supports allow: impulses change no others.
VectorXd rigid_part(const RigidMotions& motions, const Islands& islands,
                    const std::vector<ContactTerm>& terms, const VectorXd& v) {
  std::set<int> touched;
  for (const ContactTerm& term : terms)
    for (int u : term.gap.unknowns()) touched.insert(islands.blocks().block_of_unknown(u));
  VectorXd rigid = VectorXd::Zero(v.size());
  motions.add_motion(motions.coefficients(v), rigid);
  for (int b : touched) {
    if (!islands.blocks().is_free(b) && islands.blocks().is_movable(b)) continue;
    const Block& block = islands.blocks().block(b);
    const auto [linear, angular] = rigid_velocity(block, v);
    rigid.segment(block.unknowns().first, block.n_unknowns()) =
        block.rigid_modes() * Vec3(linear.x(), linear.y(), angular);
  }
  return rigid;
}

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
  NormalAndShear rates;        ///< before
  NormalAndShear rigid_rates;  ///< without those of deformation

  /// \param[in] terms  forms of all unknowns
  Setting(const BlockSystem& blocks, const Islands& islands, const std::vector<ContactTerm>& terms,
          const VectorXd& v)
      : motions(blocks, islands.hit_blocks()),
        problem(motions, rigid_terms(motions, terms)),
        rates(rates_of(terms, v)),
        rigid_rates(rates_of(terms, rigid_part(motions, islands, terms, v))) {}

  /// What the impulses take from the kinetic energy and from what moves the supports: -P . (rates before and
  /// after) / 2. Rates of deformation have no part: no rigid motion has kinetic energy in common with them.
  double loss(const NormalAndShear& P) const {
    return -dot(P, rigid_rates) - problem.change(P).squaredNorm() / 2;
  }
  /// The largest part of the way from a, whose loss must be >= 0, to b after which the loss still is.
  double largest_part(const NormalAndShear& a, const NormalAndShear& b) const {
    const NormalAndShear way{b.normal - a.normal, b.shear - a.shear};
    const VectorXd w_a = problem.change(a), w = problem.change(way);
    const double round_off =
        8 * std::numeric_limits<double>::epsilon() *
        (b.normal.cwiseAbs().dot(rigid_rates.normal.cwiseAbs()) +
         b.shear.cwiseAbs().dot(rigid_rates.shear.cwiseAbs()) + problem.change(b).squaredNorm());
    if (loss(b) >= -round_off) return 1;
    const double linear = dot(way, rigid_rates) + w.dot(w_a), constant = std::max(0., loss(a));
    const double root = std::sqrt(linear * linear + 2 * w.squaredNorm() * constant);
    return std::clamp((root - linear) / w.squaredNorm(), 0., 1.);
  }
  void finish(const NormalAndShear& P, JumpReport& report) const {
    const VectorXd w = problem.change(P);
    const NormalAndShear change = problem.change_of_rates(w);
    report.normal_loss = -P.normal.dot(rigid_rates.normal + change.normal / 2);
    report.friction_loss = -P.shear.dot(rigid_rates.shear + change.shear / 2);
    motions.add_motion(w, report.jump);
    report.n_contacts = static_cast<int>(P.normal.size());
    report.rounds = problem.n_rounds();
  }
};

/// What of an impact takes part in it.
struct Participants {
  explicit Participants(const BlockSystem& blocks) : islands(blocks) {}

  Islands islands;
  std::vector<std::size_t> contacts;  ///< indices
  std::vector<ContactTerm> terms;
  std::vector<const ImpactContact*> laws;  ///< of friction; null: bonded
  VectorXd restitution;
  double approach = 0;  ///< the largest, m/s

  /// Of |P_T| under these normal impulses.
  VectorXd bounds(const VectorXd& normal) const {
    VectorXd bounds(normal.size());
    for (Index k = 0; k < normal.size(); ++k) {
      const ImpactContact* law = laws[static_cast<std::size_t>(k)];
      bounds[k] = law ? law->bound(std::max(0.0, normal[k])) : 0;
    }
    return bounds;
  }
};

ContactTerm impact_term(const ImpactContact& contact) {
  ContactTerm term{.gap = contact.gap, .slip = contact.slip};
  term.sheared = contact.bonded || contact.friction > 0 || contact.friction_law;
  if (contact.bonded) {
    term.normal = ContactTerm::Normal::bilateral;
    term.bound = infinity;
  }
  return term;
}

Participants find_participants(const BlockSystem& blocks, const std::vector<ImpactContact>& contacts,
                               const VectorXd& v, double least_approach) {
  Participants found(blocks);
  Islands& islands = found.islands;
  for (const ImpactContact& contact : contacts) islands.join(contact.gap);
  for (const ImpactContact& contact : contacts) {
    const double approach = contact.bonded ? 0 : -contact.gap.change(v);
    if (!(approach > least_approach)) continue;
    islands.hit(contact.gap);
    found.approach = std::max(found.approach, approach);
  }
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (islands.is_hit(contacts[c].gap)) found.contacts.push_back(c);
  const auto n = static_cast<Index>(found.contacts.size());
  found.restitution = VectorXd::Zero(n);
  for (Index k = 0; k < n; ++k) {
    const ImpactContact& contact = contacts[found.contacts[static_cast<std::size_t>(k)]];
    found.terms.push_back(impact_term(contact));
    found.laws.push_back(contact.bonded ? nullptr : &contact);
    if (!contact.bonded) found.restitution[k] = contact.restitution;
  }
  return found;
}

/// Solves with friction, |P_T| <= bound(P_N + given), from impulses of zero. False: friction
/// and normal impulses do not agree, or rates do not vanish to the tolerance.
bool solve_with_friction(const NormalAndShear& rates, const Participants& of, const VectorXd& given,
                         double tolerance, ImpulseProblem& problem, int& solves) {
  bool vanish = false;
  const auto solve = [&](const VectorXd& bounds, VectorXd& wanted) {
    problem.set_bounds(bounds);
    vanish = problem.solve(rates, tolerance);
    wanted = of.bounds(problem.impulses().normal.cwiseMax(0) + given);
  };
  problem.set_impulses(zeros(given.size()));
  VectorXd bounds = of.bounds(given);
  const BoundsReport agreement = iterate_bounds(solve, {}, bounds);
  solves += agreement.solves;
  return vanish && agreement.settled;
}

}  // namespace

// What is lost is -P . (u + u') / 2 for rates u before and u' = u + G G^T P after. In compression
// u' . P <= 0, so that -P . u' + |G^T P|^2 / 2 >= 0 is lost. Of one common e without shear and second
// contact, u' . P = 0 there, and (1 + e) P leads to u' + e G G^T P: (1 + e) (1 - e) |G^T P|^2 / 2 >= 0 is
// lost. With several e, with shear, which gives nothing back, or with rates of deformation there is no such
// theorem: what would make energy is taken in part.
JumpReport impact(const BlockSystem& blocks, const std::vector<ImpactContact>& contacts, const VectorXd& v,
                  const ImpactOptions& options) {
  JumpReport report;
  report.jump = VectorXd::Zero(blocks.n_unknowns());
  report.impulses.resize(contacts.size());
  const Participants of = find_participants(blocks, contacts, v, options.least_approach);
  if (of.contacts.empty()) return report;

  Setting setting(blocks, of.islands, of.terms, v);
  ImpulseProblem& problem = setting.problem;
  const double tolerance = options.tolerance * of.approach;
  const NormalAndShear none = zeros(of.restitution.size());
  report.settled = solve_with_friction(setting.rates, of, none.normal, tolerance, problem, report.solves);
  const NormalAndShear compression = problem.impulses();
  const double compressed = setting.largest_part(none, compression);
  report.limited = compressed < 1;
  NormalAndShear total = between(none, compression, compressed);

  const VectorXd given = of.restitution.cwiseProduct(compression.normal);
  if (!report.limited && (given.array() > 0).any()) {
    NormalAndShear restored{compression.normal + given, compression.shear};
    const NormalAndShear change = problem.change_of_rates(problem.change(restored));
    const NormalAndShear rates{setting.rates.normal + change.normal, setting.rates.shear + change.shear};
    report.settled =
        solve_with_friction(rates, of, given, tolerance, problem, report.solves) && report.settled;
    const NormalAndShear second = problem.impulses();
    restored = {restored.normal + second.normal, restored.shear + second.shear};
    const double part = setting.largest_part(compression, restored);
    report.limited = part < 1;
    total = between(compression, restored, part);
  }
  const VectorXd bounds = of.bounds(total.normal);
  for (Index c = 0; c < given.size(); ++c)  // bounds agree to a tolerance: now exactly
    if (!std::isinf(of.terms[static_cast<std::size_t>(c)].bound))
      total.shear[c] = std::clamp(total.shear[c], -bounds[c], bounds[c]);
  if (!report.settled) {
    const double part = setting.largest_part(none, total);
    report.limited = report.limited || part < 1;
    total = between(none, total, part);
  }
  for (std::size_t k = 0; k < of.contacts.size(); ++k)
    report.impulses[of.contacts[k]] = {total.normal[static_cast<Index>(k)],
                                       total.shear[static_cast<Index>(k)]};
  setting.finish(total, report);
  return report;
}

}  // namespace ddacontact
