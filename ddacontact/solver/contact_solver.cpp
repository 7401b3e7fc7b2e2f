#include <ddacontact/solver/contact_solver.hpp>

#include <ddacontact/contact/for_contacts.hpp>
#include <ddacontact/solver/anderson.hpp>
#include <ddacontact/solver/contact_sweeps.hpp>
#include <ddacontact/solver/interior_point.hpp>
#include <ddacontact/solver/spring_state.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <set>

namespace ddacontact {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// A contact is so much stiffer than the compliant side of it: at least, for augmentations to converge by a
/// tenth, and at most, for its round-off to stay below the forces that the compliant side bears.
constexpr double least_stiffness_ratio = 10, largest_stiffness_ratio = 1000;
/// A dynamic step corrects this part of the gaps and slips of closed contacts, and all beyond the penetration
/// tolerance. Gaps within this part of the tolerance stay uncorrected: in a wall every correction moves
/// neighbours, for hundreds of steps.
constexpr double corrected_part = 0.2, uncorrected_part = 1e-3;
constexpr int anderson_depth = 8;
/// A contact is in another state than the law's when its force differs by this part of the largest sum of
/// forces on a block.
constexpr double negligible_force = 1e-9;
/// Limits of the active-set iteration: changes of the active set, and how many of these in a row may leave
/// the number of contacts in a wrong state undiminished.
struct Patience {
  int changes, losses;
};
constexpr Patience at_first{12, 2}, near_solution{25, 4};
/// The active-set iteration is left when, after its first change, more than `few_contacts` contacts and more
/// than this part of all are in a wrong state, or the block-relative residual exceeds the second number.
constexpr double many_changes_part = 0.08, many_changes_residual = 0.5;
constexpr int few_contacts = 100;
/// Solutions for the same states that are Newton's own, as long as geometry changes more than what is left.
constexpr int first_accelerated = 2;
/// Solutions for one active set before it is checked, and the residual reduction that allows a check earlier.
constexpr int most_solutions_of_states = 6;
constexpr double sufficient_decrease = 1e-2;
/// A factor is reused while each solution with it reduces the residual to this part: contact normals turned
/// since then leave stiff forces in soft directions.
constexpr double stale_factor_gain = 0.1;
/// Sweeps on one linearized geometry, and linearizations.
constexpr int most_sweeps = 1000, most_rounds = 12;
/// The tolerance of the last sweep over that of the step: the remaining error exceeds its change.
constexpr double part_of_last_sweep = 0.1;
/// A coarse step has many changes when more than `many_changes_part` of the contacts, and more than this
/// number, change state in its first two sweeps. It accepts this multiple of the penetration tolerance.
constexpr int few_changes = 10;
constexpr double coarse_penetration = 10;
/// Solutions without a smaller residual after which an accepted one is final.
constexpr int patience = 4;
/// Residual target, as a fraction of the round-off bound.
constexpr double round_off_target = 0.05;
/// The augmented Lagrangian multipliers of a contact, N per m.
struct Multiplier {
  double normal = 0, shear = 0;
  double gap = 0;        ///< the constant of the term's gap, the offset not taken off
  bool sliding = false;  ///< T is at the friction bound, with the sign of `shear`, until the slip reverses
  bool on_edge = false;  ///< at the start of the step
  bool bonded = false;
};

/// Complementarity: no tension beyond a bond's, no shear beyond the bound, up to round-off and `negligible`,
/// N per m.
[[maybe_unused]] bool is_admissible(const JointLaw& law, bool bonded, const ContactForce& force,
                                    double negligible) {
  constexpr double round_off = 1e-6;
  const double bound = shear_bound(law, force.normal, bonded),
               allowed = negligible + round_off * (std::abs(force.normal) + std::abs(force.shear));
  return std::isfinite(allowed) && force.normal >= -(bonded ? law.tension : 0) - allowed &&
         (law.glued || std::abs(force.shear) <= bound + allowed);
}

class ContactSolver {
 public:
  ContactSolver(StepSystem& system, const ContactSolverOptions& options, std::vector<Contact>& contacts,
                VectorXd& d)
      : system_(system),
        options_(options),
        contacts_(contacts),
        d_(d),
        terms_(contacts.size()),
        springs_(contacts.size()),
        at_d_(contacts.size()),
        forces_(contacts.size()),
        off_(contacts.size()),
        multipliers_(contacts.size()),
        states_(contacts.size()),
        tangent_(system.problem(), options.skip),
        acceleration_(anderson_depth) {}

  ContactSolverReport solve() {
    system_.linearize(d_);
    for_contacts(contacts_.size(), [&](std::size_t c) {
      start(contacts_[c], multipliers_[c]);
      states_[c] = first_state(contacts_[c], contacts_[c].law.has_friction() || multipliers_[c].bonded);
    });
    if (options_.skip.cg && !options_.is_static && (options_.local || options_.coarse)) {
      evaluate_contacts();
      if (sweep()) return settle();
    }
    report_.tolerance = options_.residual_tolerance;
    if (options_.warm_start) start_from_forces();
    look();
    system_.problem().contacts_changed();
    while (true) {
      if (!std::isfinite(report_.residual.block_relative) || !std::isfinite(report_.residual.largest))
        return end(ContactSolverStatus::not_finite);
      if (is_balanced() && (states_agree() || take_law(aim_of_states()))) {
        if (is_close()) {
          if (options_.is_static && release_bonds()) continue;
          take_law_where_negligible();
          return settle();
        }
        if (report_.augmentations - before_front_ == options_.max_augmentations)
          return end(ContactSolverStatus::penetrating);
        augment();
        continue;
      }
      if (report_.iterations >= options_.max_solutions || !follow_states()) return end(failure_);
    }
  }

 private:
  /// Stiffnesses and multipliers at the start of the step.
  void start(Contact& contact, Multiplier& multiplier) const {
    JointLaw& law = contact.law;
    const ContactHistory& history = contact.history;
    multiplier.on_edge = contact.meets || contact.is_on_edge(contact.first_slip().constant);
    multiplier.bonded = contact.has_bond();
    contact.was_closed = contact.closed();
    if (law.compliant) return start_compliant(contact, multiplier);
    if (options_.penetration_tolerance == 0) return;
    const VertexEdgePositions& place = contact.motion.start;
    const Vec2 along = (place.k - place.j).normalized(), normal(along.y(), -along.x());
    const auto [vertex_block, vertex, edge_block, edge, corner] = contact.pair;
    const double n_edges = system_.n_vertices(edge_block);
    const int next = edge + 1 == n_edges ? 0 : edge + 1;
    const double t = std::clamp((place.i - place.j).dot(along) / contact.edge_length(), 0.0, 1.0);
    const double of_vertex = system_.vertex_stiffness(vertex_block, vertex, normal),
                 of_edge = 1 / ((1 - t) * (1 - t) / system_.vertex_stiffness(edge_block, edge, normal) +
                                t * t / system_.vertex_stiffness(edge_block, next, normal));
    const double ratio = law.tangential_stiffness / law.normal_stiffness,
                 lower_stiffness = std::min(of_vertex, of_edge);
    if (std::isfinite(lower_stiffness))
      law.normal_stiffness = std::clamp(law.normal_stiffness, least_stiffness_ratio * lower_stiffness,
                                        largest_stiffness_ratio * lower_stiffness);
    law.tangential_stiffness = ratio * law.normal_stiffness;
    if (!contact.closed()) return;
    multiplier.normal = history.normal;
    multiplier.shear = history.shear;
    multiplier.sliding = is_slipping(history.state);
    multiplier.normal +=
        law.normal_stiffness * kept(contact.first_gap().constant - history.gap_offset, contact.size);
    if (!multiplier.sliding && (law.has_friction() || multiplier.bonded))
      multiplier.shear += law.tangential_stiffness * kept(contact.first_slip().constant, contact.size);
  }

  /// The joint's own springs: forces of the end of the step, or the means of both ends.
  void start_compliant(const Contact& contact, Multiplier& multiplier) const {
    if (!contact.closed()) return;
    multiplier.shear = contact.history.shear + shear_stiffness(contact.law) * contact.first_slip().constant;
    if (!has_means()) return;
    multiplier.normal = contact.history.normal / 2;
  }
  bool has_means() const { return options_.directions == Directions::mean; }
  double shear_stiffness(const JointLaw& law) const {
    return law.tangential_stiffness * (law.compliant && has_means() ? 1. / 2 : 1);
  }

  /// Warm start: the states of the forces that solve a problem that differs little.
  void start_from_forces() {
    near_ = true;
    evaluate_contacts();
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      states_[c] = state_of(terms_[c], contacts_[c].law, multipliers_[c].bonded,
                            {contacts_[c].normal, contacts_[c].shear});
  }

  /// What a step leaves of the gap or slip that a closed contact of blocks of this size starts with.
  double kept(double length, double size) const {
    const double most = options_.penetration_tolerance * size, least = uncorrected_part * most,
                 within = std::min(std::abs(length), most),
                 left = options_.is_static ? 0 : (1 - corrected_part) * within;
    return std::copysign(within <= least ? within : std::max(least, left), length);
  }

  /// Geometry, terms, forces and residual at d.
  void look() {
    displaced_ = system_.displacement(d_);
    for_contacts(contacts_.size(), [&](std::size_t c) {
      evaluate(contacts_[c], multipliers_[c], terms_[c]);
      springs_[c] = springs_at(terms_[c], d_);
      at_d_[c] = state_at(terms_[c], contacts_[c].law, springs_[c]);
      follow_state(c);
    });
    balance();
  }

  /// Forces and residual of other states at the same d.
  void evaluate_states() {
    for_contacts(contacts_.size(), [&](std::size_t c) { follow_state(c); });
    balance();
  }

  /// The forces of a contact in its state, and how far they are off the law.
  void follow_state(std::size_t c) {
    const ContactForce force = forces_[c] =
                           force_in_state(contacts_[c].law, multipliers_[c].bonded, states_[c], springs_[c]),
                       law = law_force(c);
    off_[c] = at_d_[c] == states_[c] ? 0 : std::hypot(force.normal - law.normal, force.shear - law.shear);
  }
  ContactForce law_force(std::size_t c) const {
    return {springs_[c].normal.clipped(), springs_[c].tangential.clipped()};
  }

  void balance() {
    system_.compute_residual(d_, contacts_, terms_, forces_, report_.residual);
    if (report_.residual.block_relative < best_) {
      best_ = report_.residual.block_relative;
      since_best_ = 0;
    } else {
      ++since_best_;
    }
  }

  void evaluate(const Contact& contact, Multiplier& multiplier, ContactTerm& term) const {
    const MovingVertexEdge& m = contact.motion;
    const auto [start_gap, g, s, dg, ds] =
        m.gap_and_slip_at(displaced_, contact.history.lock, options_.directions);
    term.gap = m.linear_form(g, dg, d_);
    term.slip = m.linear_form(s, ds, d_);
    multiplier.gap = term.gap.constant;
    term.gap.constant -= contact.history.gap_offset;

    const JointLaw& law = contact.law;
    term.normal_stiffness =
        law.normal_stiffness * (law.compliant && has_means() ? 1. / 2 : 1) + contact.damping;
    term.tangential_stiffness = shear_stiffness(law);
    term.normal_multiplier = multiplier.normal + contact.damping * (start_gap - contact.history.gap_offset);
    const bool possible =
        multiplier.on_edge || multiplier.bonded || contact.closed() || contact.is_on_edge(s);
    term.tension = multiplier.bonded ? law.tension : 0;
    term.normal = !possible                 ? ContactTerm::Normal::absent
                  : term.tension < infinity ? ContactTerm::Normal::unilateral
                                            : ContactTerm::Normal::bilateral;
    term.sheared = multiplier.bonded || law.has_friction() || !options_.skip.friction_rows;
    term.bound = shear_bound(law, normal_spring(term, d_).clipped(), multiplier.bonded);
    term.tangential_multiplier = term.bound == 0      ? 0
                                 : multiplier.sliding ? std::copysign(term.bound, multiplier.shear)
                                                      : std::clamp(multiplier.shear, -term.bound, term.bound);
  }

  bool is_balanced() const {
    const double own = report_.residual.block_relative;
    if (own == 0 && report_.residual.over_round_off > round_off_target && since_best_ < patience)
      return false;
    return own <= options_.residual_aim || (own <= options_.residual_tolerance && since_best_ >= patience);
  }

  /// Begins to look for a residual anew, from the law's states: what is to be balanced has changed.
  void restart() {
    states_ = at_d_;
    best_ = infinity;
    since_best_ = 0;
    begin_states();
    look();
    acceleration_.reset();
    interior_point_done_ = false;
  }

  int count_disagreeing() const {
    const double counts = negligible_force * report_.residual.scale;
    return static_cast<int>(
        std::count_if(off_.begin(), off_.end(), [&](double off) { return off > counts; }));
  }
  bool states_agree() const { return count_disagreeing() == 0; }
  /// What the forces of the law may leave where they differ from those of the states: more when these have
  /// changed so often.
  double aim_of_states() const {
    return changes_ >= patience ? options_.residual_tolerance : options_.residual_aim;
  }

  /// The state to try next. Near a solution a contact that sticks while it is pulled slides before it opens:
  /// it may be its own friction that pulls.
  unsigned char next(std::size_t c) const {
    const unsigned char now = states_[c], at_d = at_d_[c];
    if (near_ && now == (normal_acts | shear_acts) && at_d == open)
      return normal_acts | (forces_[c].shear > 0 ? at_upper : at_lower);
    return next_state(now, at_d);
  }

  /// Gives every contact that disagrees its next state; when that has been seen before, the one that is
  /// furthest from its law. False: that too.
  bool change_states() {
    std::vector<unsigned char> all = states_;
    std::size_t worst = 0;
    double furthest = 0;
    for (std::size_t c = 0; c < terms_.size(); ++c) {
      const double off = off_[c];
      if (off <= negligible_force * report_.residual.scale) continue;
      all[c] = next(c);
      if (off > furthest) {
        furthest = off;
        worst = c;
      }
    }
    if (seen_.contains(all))
      states_[worst] = next(worst);
    else
      states_ = std::move(all);
    return seen_.insert(states_).second;
  }

  /// Takes the forces and states of the law at d if these leave balance to a tolerance too. False: they do
  /// not.
  bool take_law(double tolerance) {
    std::vector<ContactForce> forces(terms_.size());
    for (std::size_t c = 0; c < terms_.size(); ++c) forces[c] = law_force(c);
    Residual residual;
    system_.compute_residual(d_, contacts_, terms_, forces, residual);
    if (!(residual.block_relative <= tolerance)) return false;
    states_ = at_d_;
    forces_ = std::move(forces);
    std::fill(off_.begin(), off_.end(), 0);
    report_.residual = std::move(residual);
    return true;
  }

  /// Forces that differ from the law's by what does not count: inside the cone they are the law's.
  void take_law_where_negligible() {
    if (states_ != at_d_) take_law(options_.residual_tolerance);
  }

  std::vector<SweptLaw> laws() const {
    std::vector<SweptLaw> laws(contacts_.size());
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const Multiplier& m = multipliers_[c];
      const VertexEdge& pair = contacts_[c].pair;
      laws[c] = {&contacts_[c].law,
                 m.shear,
                 m.sliding,
                 m.bonded,
                 std::min(system_.sum_of_forces(pair.vertex_block), system_.sum_of_forces(pair.edge_block)),
                 options_.penetration_tolerance * contacts_[c].size};
    }
    return laws;
  }

  /// Sweeps over the contacts, from the forces of the step before, until forces and geometry have converged;
  /// sets d and the states. False: the active-set iteration has to solve the step, in quiet steps from the
  /// d before.
  bool sweep() {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const Contact& contact = contacts_[c];
      if (options_.warm_start)
        forces_[c] = {contact.normal, contact.shear};
      else if (contact.closed())
        forces_[c] = {contact.history.normal, contact.history.shear};
    }
    const ContactSweeps::Tolerance tight{part_of_last_sweep * options_.residual_tolerance},
        coarse{options_.residual_tolerance, coarse_penetration}, any{infinity, infinity};
    ContactSweeps::Stop stop{options_.local ? tight : any, coarse,
                             options_.coarse ? many_changes_part : infinity, few_changes, most_sweeps};
    for (int round = 0; round < most_rounds; ++round) {
      system_.compute_residual(d_, contacts_, terms_, forces_, report_.residual);
      if (round == 0 || !options_.keeps_gradients()) {
        if (round > 0) system_.linearize(d_);
        if (!sweeps_.set(system_.problem(), terms_)) return false;
      }
      VectorXd d = d_;
      const std::vector<SweptLaw> laws = this->laws();
      const ContactSweeps::Report swept =
          sweeps_.sweep(terms_, laws, report_.residual.force, stop, d, forces_);
      report_.sweeps += swept.sweeps;
      if (swept.many_changes) {
        many_changes_ = true;
        stop.quiet = coarse;
      }
      if (!options_.local && !many_changes_) return false;
      const VectorXd change = d - d_;
      system_.move(change, d_);
      const bool is_straight = options_.keeps_gradients() && stays_straight(change, laws, stop.quiet.force);
      if (!is_straight) evaluate_contacts();
      for (std::size_t c = 0; c < contacts_.size(); ++c) {
        springs_[c] = springs_at(terms_[c], d_);
        at_d_[c] = states_[c] = state_of(terms_[c], contacts_[c].law, multipliers_[c].bonded, forces_[c]);
      }
      if (!swept.settled) break;
      if (drop_forces_beyond_edges() ||
          (!is_straight && (round == 0 || swept.sweeps > (many_changes_ ? 2 : 1))))
        continue;
      if (is_close()) {
        system_.compute_residual(d_, contacts_, terms_, forces_, report_.residual);
        report_.tolerance = options_.residual_tolerance;
        // Where forces of blocks are not linear sweeps are Newton's steps.
        if (report_.residual.block_relative <=
            (options_.keeps_gradients() ? report_.tolerance : options_.residual_aim))
          return true;
        continue;
      }
      raise_multipliers();
      evaluate_contacts();
    }
    many_changes_ = false;
    before_front_ = report_.augmentations;
    ++report_.tangent.fallbacks;
    return false;
  }

  /// Of vertices that d leads off their edges. False: there are none.
  bool drop_forces_beyond_edges() {
    bool any = false;
    for (std::size_t c = 0; c < terms_.size(); ++c) {
      if (terms_[c].normal != ContactTerm::Normal::absent || forces_[c].normal == 0) continue;
      forces_[c] = {};
      any = true;
    }
    return any;
  }

  /// Whether gaps follow their gradients of the start on the last part of the way to d as far as forces can
  /// tell: a block that has turned on its way leads its points off them by no more than its way over its
  /// size.
  bool stays_straight(const VectorXd& change, const std::vector<SweptLaw>& laws, double tolerance) const {
    std::vector<double> bends(static_cast<std::size_t>(system_.n_blocks()));
    for (int b = 0; b < system_.n_blocks(); ++b) {
      const double last = system_.largest_motion(b, change), way = system_.largest_motion(b, d_) + last;
      bends[static_cast<std::size_t>(b)] = last * way / system_.size_of(b);
    }
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const VertexEdge& pair = contacts_[c].pair;
      const double bend = bends[static_cast<std::size_t>(pair.vertex_block)] +
                          bends[static_cast<std::size_t>(pair.edge_block)];
      if (terms_[c].normal_stiffness * bend > tolerance * laws[c].scale) return false;
    }
    return true;
  }

  void evaluate_contacts() {
    displaced_ = system_.displacement(d_);
    for_contacts(contacts_.size(),
                 [&](std::size_t c) { evaluate(contacts_[c], multipliers_[c], terms_[c]); });
  }

  /// Active-set iteration: solves for given states, then checks whether they agree with the solution.
  bool follow_states() {
    const bool solved = report_.residual.block_relative <= sufficient_decrease * first_of_states_ ||
                        is_balanced() || solutions_of_states_ >= most_solutions_of_states;
    if (solutions_of_states_ > 0 && solved && !states_agree()) {
      const int disagreeing = count_disagreeing();
      lost_ = disagreeing < fewest_disagreeing_ ? 0 : lost_ + 1;
      fewest_disagreeing_ = std::min(fewest_disagreeing_, disagreeing);
      const Patience& most = near_ ? near_solution : at_first;
      const bool many_changes =
          !near_ && disagreeing > few_contacts &&
          (report_.residual.block_relative > many_changes_residual ||
           (changes_ == 1 && disagreeing > many_changes_part * static_cast<double>(terms_.size())));
      if (many_changes || lost_ > most.losses || ++changes_ > most.changes || !change_states())
        return leave_active_set();
      solutions_of_states_ = 0;
      best_ = infinity;
      evaluate_states();
    }
    if (since_best_ > 3 * patience) return leave_active_set();
    if (solutions_of_states_ == 0 ||
        report_.residual.block_relative > stale_factor_gain * last_block_relative_) {
      system_.linearize(d_);
      if (solutions_of_states_ == 0) acceleration_.reset();
      if (solutions_of_states_ == 0) first_of_states_ = report_.residual.block_relative;
    }
    last_block_relative_ = report_.residual.block_relative;
    std::vector<unsigned char> active(states_.size());
    for (std::size_t c = 0; c < states_.size(); ++c) active[c] = states_[c] & (normal_acts | shear_acts);
    if (!tangent_.solve(terms_, active, couplings(), report_.residual.force, correction_))
      return leave_active_set();
    VectorXd next = d_;
    if (solutions_of_states_ >= first_accelerated)
      acceleration_.advance(-correction_, system_.unknown_lengths(), next);
    else
      next -= correction_;
    system_.move(next - d_, d_);
    ++report_.iterations;
    ++solutions_of_states_;
    look();
    if (!std::isfinite(report_.residual.largest)) return leave_active_set();
    return true;
  }

  /// Leaves the active-set iteration for the interior-point method, once. False: that was done before.
  bool leave_active_set() {
    return !interior_point_done_ && options_.interior_point && find_by_interior_point();
  }

  void begin_states() {
    changes_ = solutions_of_states_ = lost_ = 0;
    fewest_disagreeing_ = static_cast<int>(terms_.size()) + 1;
    seen_.clear();
  }

  /// Moves d and the states near to a solution by the interior-point method. False: it failed.
  bool find_by_interior_point() {
    interior_point_done_ = near_ = true;
    ++report_.interior_point_solves;
    d_ = system_.prescribed();
    const InteriorReport found = find_interior_point_states(
        system_, contacts_, laws(), [this] { evaluate_contacts(); }, terms_, d_, states_);
    report_.iterations += found.solutions;
    report_.interior_solutions += found.solutions;
    report_.tangent.fallbacks += found.fallbacks;
    begin_states();
    best_ = infinity;
    since_best_ = 0;
    look();
    if (!found.found) failure_ = ContactSolverStatus::not_positive_definite;
    return found.found;
  }

  /// The sign of shear forces that follow the bound of friction: of contacts that slide, and of those whose
  /// multiplier is at the bound. 0: they do not.
  int follows_bound(std::size_t c) const {
    if (states_[c] & at_upper) return 1;
    if (states_[c] & at_lower) return -1;
    const Multiplier& m = multipliers_[c];
    const double bound = terms_[c].bound;
    const bool at_bound = m.sliding || std::abs(m.shear) > bound;
    return (states_[c] & shear_acts) && at_bound && bound < infinity && forces_[c].normal > -terms_[c].tension
               ? (m.shear > 0 ? 1 : -1)
               : 0;
  }

  /// Friction that follows normal forces.
  std::vector<Coupling> couplings() const {
    std::vector<Coupling> couplings;
    for (std::size_t c = 0; c < terms_.size(); ++c) {
      const int sense = follows_bound(c);
      const double rate = friction_rate(contacts_[c].law, forces_[c].normal, multipliers_[c].bonded) *
                          terms_[c].normal_stiffness;
      if (sense != 0 && rate != 0) couplings.push_back({&terms_[c].slip, &terms_[c].gap, sense * rate, c});
    }
    return couplings;
  }

  /// Whether a bond bears its strength and gives way.
  bool yields(std::size_t c) const {
    if (!multipliers_[c].bonded) return false;
    const bool opens = !(at_d_[c] & normal_acts) && terms_[c].gap(d_) > contacts_[c].length_tolerance();
    return opens || (is_sliding(c) && !contacts_[c].law.ductile);
  }

  /// Breaks the bonds that yield; false: none does.
  bool break_bonds() {
    bool any = false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (!yields(c)) continue;
      contacts_[c].history.bonded = false;
      any = true;
    }
    return any;
  }

  /// The same within the step.
  bool release_bonds() {
    if (!break_bonds()) return false;
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      multipliers_[c].bonded = multipliers_[c].bonded && contacts_[c].has_bond();
    before_front_ = report_.augmentations;
    restart();
    return true;
  }

  /// Whether closed contacts touch and sticking ones stay within the tolerance.
  bool is_close() {
    if (options_.penetration_tolerance == 0) return true;
    double worst = 1;
    report_.worst_contact = -1;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (contacts_[c].law.compliant) continue;
      const double tolerance =
          (many_changes_ ? coarse_penetration : 1) * options_.penetration_tolerance * contacts_[c].size;
      double error = 0;
      if (springs_[c].normal.acts()) error = std::abs(terms_[c].gap(d_));
      if (springs_[c].tangential.acts() && forces_[c].shear != 0)
        error = std::max(error, std::abs(terms_[c].slip(d_)));
      if (error > worst * tolerance) {
        worst = error / tolerance;
        report_.worst_contact = static_cast<int>(c);
      }
    }
    return report_.worst_contact < 0;
  }

  void augment() {
    raise_multipliers();
    restart();
  }

  void raise_multipliers() {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (contacts_[c].law.compliant) continue;
      Multiplier& multiplier = multipliers_[c];
      multiplier.normal = elastic_normal(c);
      multiplier.shear = forces_[c].shear;
      multiplier.sliding = is_sliding(c);
    }
    ++report_.augmentations;
  }

  /// N without the dashpot's part.
  double elastic_normal(std::size_t c) const {
    return springs_[c].normal.acts()
               ? forces_[c].normal + contacts_[c].damping * (gap_at_d(c) - contacts_[c].motion.start_gap())
               : forces_[c].normal;
  }

  /// Without its offset.
  double gap_at_d(std::size_t c) const { return multipliers_[c].gap + terms_[c].gap.change(d_); }

  bool is_sliding(std::size_t c) const { return at_d_[c] & (at_upper | at_lower); }

  ContactSolverReport settle() {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      Contact& contact = contacts_[c];
      ContactHistory& history = contact.history;
      assert(is_admissible(contact.law, multipliers_[c].bonded, forces_[c],
                           negligible_force * report_.residual.scale));
      const bool closed = forces_[c].normal > 0 || (multipliers_[c].bonded && contact.closed());
      if (!closed)
        history.state = ContactState::open;
      else if (!contact.law.has_friction() && !multipliers_[c].bonded)
        history.state = ContactState::slip_forward;
      else if (is_sliding(c))
        history.state = forces_[c].shear < 0 ? ContactState::slip_forward : ContactState::slip_backward;
      else
        history.state = ContactState::stick;
      contact.was_closed = contact.was_closed || closed;
      contact.normal = forces_[c].normal;
      contact.shear = forces_[c].shear;
    }
    break_bonds();
    return end(ContactSolverStatus::settled);
  }

  /// The contact with the largest force on the block that is furthest from balance; -1: it touches nothing.
  int find_unbalanced() const {
    int worst = -1;
    double largest = 0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const VertexEdge& pair = contacts_[c].pair;
      const double force = std::hypot(forces_[c].normal, forces_[c].shear);
      const bool touches_it = pair.vertex_block == report_.residual.worst_block ||
                              pair.edge_block == report_.residual.worst_block;
      if (!touches_it || force <= largest) continue;
      worst = static_cast<int>(c);
      largest = force;
    }
    return worst;
  }

  ContactSolverReport end(ContactSolverStatus status) {
    for_contacts(contacts_.size(), [&](std::size_t c) {
      contacts_[c].gap = gap_at_d(c);
      contacts_[c].gap_change = terms_[c].gap.change(d_);
      contacts_[c].slip_change = terms_[c].slip.change(d_);
      contacts_[c].end_slip = terms_[c].slip(d_);
    });
    if (status == ContactSolverStatus::unsettled) report_.worst_contact = find_unbalanced();
    report_.status = status;
    report_.tangent += tangent_.counts();
    return std::move(report_);
  }

  StepSystem& system_;
  const ContactSolverOptions& options_;
  std::vector<Contact>& contacts_;
  VectorXd& d_;
  VectorXd displaced_;  ///< where d leads to
  std::vector<ContactTerm> terms_;
  std::vector<ContactSprings> springs_;  ///< of the terms at d
  std::vector<unsigned char> at_d_;      ///< states of the law there
  std::vector<ContactForce> forces_;
  std::vector<double> off_;  ///< the force by which the law differs from the springs of the state
  std::vector<Multiplier> multipliers_;
  ContactSolverReport report_;
  int before_front_ = 0;  ///< augmentations by sweeps, and before bonds broke last
  double best_ = infinity;
  int since_best_ = 0;

  ContactSolverStatus failure_ = ContactSolverStatus::unsettled;  ///< how to end when nothing is left to try
  std::vector<unsigned char> states_;
  std::set<std::vector<unsigned char>> seen_;
  int changes_ = 0, solutions_of_states_ = 0, lost_ = 0;
  int fewest_disagreeing_ = static_cast<int>(contacts_.size()) + 1;
  bool many_changes_ = false;         ///< many contacts change their states, and sweeps find the forces
  bool interior_point_done_ = false;  ///< the states were found by the interior-point method
  bool near_ = false;                 ///< a solution is near: by that method or a warm start
  double last_block_relative_ = infinity, first_of_states_ = infinity;
  TangentSolver tangent_;
  ContactSweeps sweeps_;
  AndersonAcceleration acceleration_;
  VectorXd correction_;
};

}  // namespace

ContactSolverReport solve_contacts(StepSystem& system, const ContactSolverOptions& options,
                                   std::vector<Contact>& contacts, VectorXd& d) {
  return ContactSolver(system, options, contacts, d).solve();
}

}  // namespace ddacontact
