#include <ddacontact/time/rigid_velocities.hpp>

#include <ddacontact/solver/friction_bounds.hpp>
#include <ddacontact/time/impulse_problem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace ddacontact {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr double hold_tolerance = 1e-12;  ///< of the largest rate to take out

/// Blocks joined to one another by contacts; those of some islands take part in a jump.
class Islands {
 public:
  explicit Islands(const BlockSystem& blocks) : blocks_(blocks), parent_(blocks.n_blocks()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (int b = 0; b < blocks.n_blocks(); ++b)
      block_of_unknown_.insert(block_of_unknown_.end(), blocks.block(b).n_unknowns(), b);
  }
  void join(const AffineForm& form) {
    const int first = first_movable(form);
    for (int u : form.unknowns())
      if (blocks_.is_movable(block_of_unknown_[u])) parent_[root(block_of_unknown_[u])] = root(first);
  }
  /// Once all are joined: the island that the form belongs to takes part.
  void hit(const AffineForm& form) {
    if (const int b = first_movable(form); b >= 0) hit_.insert(root(b));
  }
  bool is_hit(const AffineForm& form) const {
    const int b = first_movable(form);
    return b >= 0 && hit_.contains(root(b));
  }
  std::vector<int> hit_blocks() const {
    std::vector<int> blocks;
    for (int b = 0; b < blocks_.n_blocks(); ++b)
      if (blocks_.is_movable(b) && hit_.contains(root(b))) blocks.push_back(b);
    return blocks;
  }

 private:
  /// -1: none
  int first_movable(const AffineForm& form) const {
    for (int u : form.unknowns())
      if (blocks_.is_movable(block_of_unknown_[u])) return block_of_unknown_[u];
    return -1;
  }
  int root(int b) const {
    while (parent_[b] != b) b = parent_[b];
    return b;
  }

  const BlockSystem& blocks_;
  std::vector<int> parent_, block_of_unknown_;
  std::set<int> hit_;  ///< by root
};

/// The largest part of the way from a to b, 0 .. 1, that leaves no more kinetic energy than q has, when the
/// change a does so.
double largest_part(const VectorXd& q, const VectorXd& a, const VectorXd& b) {
  const VectorXd way = b - a;
  const double quadratic = way.squaredNorm() / 2, linear = way.dot(q + a), constant = a.dot(q + a / 2);
  const double excess = quadratic + linear + constant;  // of b
  if (excess <= 8 * std::numeric_limits<double>::epsilon() * (q.squaredNorm() + b.squaredNorm())) return 1;
  const double root = std::sqrt(std::max(0., linear * linear - 4 * quadratic * std::min(constant, 0.)));
  return std::clamp((root - linear) / (2 * quadratic), 0., 1.);
}

/// Contacts and the rigid motions of the blocks that they join.
struct Setting {
  RigidMotions motions;
  VectorXd q;            ///< before
  NormalAndShear rates;  ///< before, those of deformation included
  ImpulseProblem problem;

  /// \param[in] terms  forms of all unknowns
  Setting(const BlockSystem& blocks, const std::vector<int>& movable, const std::vector<ContactTerm>& terms,
          const VectorXd& v)
      : motions(blocks, movable), q(motions.coefficients(v)), problem(motions, rigid_terms(motions, terms)) {
    const auto n = static_cast<Index>(terms.size());
    rates = {VectorXd(n), VectorXd(n)};
    for (Index c = 0; c < n; ++c) {
      rates.normal[c] = terms[static_cast<std::size_t>(c)].gap.change(v);
      rates.shear[c] = terms[static_cast<std::size_t>(c)].slip.change(v);
    }
  }

 private:
  static std::vector<ContactTerm> rigid_terms(const RigidMotions& motions, std::vector<ContactTerm> terms) {
    for (ContactTerm& term : terms) {
      term.gap = motions.rate_form(term.gap);
      term.slip = motions.rate_form(term.slip);
    }
    return terms;
  }
};

/// What of an impact takes part in it.
struct Participants {
  std::vector<int> movable;           ///< blocks
  std::vector<std::size_t> contacts;  ///< indices
  std::vector<ContactTerm> terms;
  VectorXd friction, restitution;
  double approach = 0;  ///< the largest, m/s
};

ContactTerm impact_term(const ImpactContact& contact) {
  ContactTerm term{.gap = contact.gap, .slip = contact.slip};
  term.sheared = contact.bonded || contact.friction > 0;
  if (contact.bonded) {
    term.normal = ContactTerm::Normal::bilateral;
    term.bound = infinity;
  }
  return term;
}

Participants find_participants(const BlockSystem& blocks, const std::vector<ImpactContact>& contacts,
                               const VectorXd& v, double least_approach) {
  Participants found;
  Islands islands(blocks);
  for (const ImpactContact& contact : contacts) islands.join(contact.gap);
  for (const ImpactContact& contact : contacts) {
    const double approach = contact.bonded ? 0 : -contact.gap.change(v);
    if (!(approach > least_approach)) continue;
    islands.hit(contact.gap);
    found.approach = std::max(found.approach, approach);
  }
  found.movable = islands.hit_blocks();
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (islands.is_hit(contacts[c].gap)) found.contacts.push_back(c);
  const auto n = static_cast<Index>(found.contacts.size());
  found.friction = found.restitution = VectorXd::Zero(n);
  for (Index k = 0; k < n; ++k) {
    const ImpactContact& contact = contacts[found.contacts[static_cast<std::size_t>(k)]];
    found.terms.push_back(impact_term(contact));
    if (contact.bonded) continue;
    found.friction[k] = contact.friction;
    found.restitution[k] = contact.restitution;
  }
  return found;
}

/// Solves with Coulomb friction, |P_T| <= friction * (P_N + given), from impulses of zero. False: friction
/// and normal impulses do not agree, or rates do not vanish to the tolerance.
bool solve_with_friction(const NormalAndShear& rates, const VectorXd& friction, const VectorXd& given,
                         double tolerance, ImpulseProblem& problem, int& solves) {
  bool vanish = false;
  const auto solve = [&](const VectorXd& bounds, VectorXd& wanted) {
    problem.set_bounds(bounds);
    vanish = problem.solve(rates, tolerance);
    wanted = friction.cwiseProduct(problem.impulses().normal.cwiseMax(0) + given);
  };
  problem.set_impulses({VectorXd::Zero(given.size()), VectorXd::Zero(given.size())});
  VectorXd bounds = friction.cwiseProduct(given);
  const BoundsReport agreement = iterate_bounds(solve, {}, bounds);
  solves += agreement.solves;
  return vanish && agreement.settled;
}

/// The part of the velocity that the impulses add, and what it costs. The losses are those of the rigid
/// motions, to which all other velocities are orthogonal.
void finish(const Setting& setting, const NormalAndShear& impulses, JumpReport& report) {
  const VectorXd w = setting.problem.change(impulses);
  const NormalAndShear mean = setting.problem.change_of_rates(setting.q + w / 2);
  report.normal_loss = -impulses.normal.dot(mean.normal);
  report.friction_loss = -impulses.shear.dot(mean.shear);
  setting.motions.add_motion(w, report.jump);
  report.n_contacts = static_cast<int>(impulses.normal.size());
  report.rounds = setting.problem.n_rounds();
  report.iterations = setting.problem.n_iterations();
}

/// a + part (b - a)
NormalAndShear between(const NormalAndShear& a, const NormalAndShear& b, double part) {
  return {a.normal + part * (b.normal - a.normal), a.shear + part * (b.shear - a.shear)};
}

}  // namespace

// Why compression takes energy: for frozen bounds b, w minimizes |w|^2 / 2 + I(G (q + w) >= 0) + b |T (q +
// w)|, so that q + w is the proximal point of q of a convex function that is least at 0: |q + w|^2 + |w|^2 <=
// |q|^2, which is w . (q + w) <= 0. The jump (1 + e) w of one common e without shear then has the energy (1 +
// e) (w . (q + w) - (1 - e) |w|^2 / 2) <= 0. With several e, with shear, which gives nothing back, or with
// rates of deformation there is no such theorem: what gives too much is taken in part.
JumpReport impact(const BlockSystem& blocks, const std::vector<ImpactContact>& contacts, const VectorXd& v,
                  const ImpactOptions& options) {
  JumpReport report;
  report.jump = VectorXd::Zero(blocks.n_unknowns());
  report.impulses.resize(contacts.size());
  const Participants of = find_participants(blocks, contacts, v, options.least_approach);
  if (of.contacts.empty()) return report;

  Setting setting(blocks, of.movable, of.terms, v);
  ImpulseProblem& problem = setting.problem;
  const double tolerance = options.tolerance * of.approach;
  const NormalAndShear none{VectorXd::Zero(of.friction.size()), VectorXd::Zero(of.friction.size())};
  report.settled =
      solve_with_friction(setting.rates, of.friction, none.normal, tolerance, problem, report.solves);
  report.largest_rate = problem.largest_rate();
  const NormalAndShear compression = problem.impulses();
  const VectorXd w = problem.change(compression);
  NormalAndShear total = between(none, compression, largest_part(setting.q, VectorXd::Zero(w.size()), w));
  report.limited = total.normal != compression.normal;

  const VectorXd given = of.restitution.cwiseProduct(compression.normal);
  if (!report.limited && (given.array() > 0).any()) {
    NormalAndShear restored{compression.normal + given, compression.shear};
    const NormalAndShear change = problem.change_of_rates(problem.change(restored));
    const NormalAndShear rates{setting.rates.normal + change.normal, setting.rates.shear + change.shear};
    report.settled =
        solve_with_friction(rates, of.friction, given, tolerance, problem, report.solves) && report.settled;
    const NormalAndShear second = problem.impulses();
    restored = {restored.normal + second.normal, restored.shear + second.shear};
    const double part = largest_part(setting.q, w, problem.change(restored));
    report.limited = part < 1;
    total = between(compression, restored, part);
  }
  for (Index c = 0; c < given.size(); ++c) {  // bounds agree to a tolerance: now exactly
    if (std::isinf(of.terms[static_cast<std::size_t>(c)].bound)) continue;
    const double bound = of.friction[c] * total.normal[c];
    total.shear[c] = std::clamp(total.shear[c], -bound, bound);
  }
  if (!report.settled) {
    const double part = largest_part(setting.q, VectorXd::Zero(w.size()), problem.change(total));
    report.limited = report.limited || part < 1;
    total = between(none, total, part);
  }
  for (std::size_t k = 0; k < of.contacts.size(); ++k)
    report.impulses[of.contacts[k]] = {total.normal[static_cast<Index>(k)],
                                       total.shear[static_cast<Index>(k)]};
  finish(setting, total, report);
  return report;
}

JumpReport hold(const BlockSystem& blocks, const std::vector<HeldContact>& contacts, const VectorXd& v) {
  JumpReport report;
  report.jump = VectorXd::Zero(blocks.n_unknowns());
  report.impulses.resize(contacts.size());
  Islands islands(blocks);
  std::vector<std::size_t> holding;
  std::vector<ContactTerm> terms;
  double largest = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const HeldContact& contact = contacts[c];
    if (!contact.normal && !contact.tangential) continue;
    islands.join(contact.gap);
    ContactTerm term{.gap = contact.normal ? contact.gap : contact.slip, .slip = contact.slip};
    term.normal = ContactTerm::Normal::bilateral;
    term.sheared = contact.normal && contact.tangential;
    term.bound = infinity;
    largest = std::max(largest, std::abs(term.gap.change(v)));
    if (term.sheared) largest = std::max(largest, std::abs(term.slip.change(v)));
    holding.push_back(c);
    terms.push_back(term);
  }
  if (largest == 0) return report;

  for (const ContactTerm& term : terms) islands.hit(term.gap);
  Setting setting(blocks, islands.hit_blocks(), terms, v);
  report.settled = setting.problem.solve(setting.rates, hold_tolerance * largest);
  report.solves = 1;
  report.largest_rate = setting.problem.largest_rate();
  const NormalAndShear whole = setting.problem.impulses();
  const VectorXd w = setting.problem.change(whole);
  const double part = largest_part(setting.q, VectorXd::Zero(w.size()), w);
  report.limited = part < 1;
  const NormalAndShear total{part * whole.normal, part * whole.shear};
  for (std::size_t k = 0; k < holding.size(); ++k) {
    const double normal = total.normal[static_cast<Index>(k)], shear = total.shear[static_cast<Index>(k)];
    report.impulses[holding[k]] =
        contacts[holding[k]].normal ? ContactImpulse{normal, shear} : ContactImpulse{0, normal};
  }
  finish(setting, total, report);
  return report;
}

}  // namespace ddacontact
