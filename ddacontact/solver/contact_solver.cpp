#include <ddacontact/solver/contact_solver.hpp>

#include <ddacontact/core/for_all.hpp>
#include <ddacontact/solver/anderson.hpp>
#include <ddacontact/solver/augmented_contacts.hpp>
#include <ddacontact/solver/interior_point.hpp>
#include <ddacontact/solver/swept_step.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <utility>

namespace ddacontact {

namespace {

/// A contact is in another state than the law's when its force differs by this part of the largest sum of
/// forces on a block.
constexpr double negligible_force = 1e-9;
/// Changes of the active set; and, of those that the interior-point method can still replace, how many may be
/// behind the rate at which each leaves half of the contacts in a wrong state: at that rate it takes less.
constexpr int most_changes = 25, changes_behind = 2;
/// Solutions for the same states that are Newton's own, as long as geometry changes more than what is left.
constexpr int first_accelerated = 2;
/// Solutions for one active set before it is checked, and the residual reduction that allows a check earlier.
constexpr int most_solutions_of_states = 6;
constexpr double sufficient_decrease = 1e-2;
/// A factor is reused while each solution with it reduces the residual to this part: contact normals turned
/// since then leave stiff forces in soft directions.
constexpr double kept_factor_gain = 0.1;
/// Solutions without a smaller residual after which an accepted one is final, and after which states are
/// left; changes of the active set from which on an accepted residual is final.
constexpr int patience = 4, most_in_vain = 12, changes_until_accepted = patience;
/// Residual target, as a fraction of the round-off bound.
constexpr double round_off_target = 0.05;

struct ContactSolver {
  StepProblem& system;
  const ContactSolverOptions& options;
  AugmentedContacts contacts;
  VectorXd& d;
  std::vector<unsigned char> states = std::vector<unsigned char>(contacts.size());  ///< the active set
  std::vector<double> off = std::vector<double>(contacts.size());  ///< the law's force from the state's
  ContactSolverReport report{};
  int before_front = 0;  ///< augmentations by sweeps, and before bonds broke last
  double best = inf;
  int since_best = 0;

  SolutionStatus failure = SolutionStatus::forces_unsettled;  ///< how to end when nothing is left to try
  std::set<std::vector<unsigned char>> seen{};
  int changes = 0, solutions_of_states = 0;
  int first_disagreeing = 0;         ///< contacts, before the first change
  bool interior_point_done = false;  ///< the states were found by the interior-point method
  /// What hardly penetrates: with motion to follow only where nothing else was found.
  bool leaves_open = options.is_static;
  bool near = false;  ///< a solution is near: by that method or a warm start
  double last_block_relative = inf, first_of_states = inf;
  AndersonAcceleration acceleration{};
  VectorXd correction{};

  ContactSolverReport solve() {
    assert(d.size() == system.prescribed().size() && options.residual_aim <= options.residual_tolerance);
    if (!d.allFinite()) return end(SolutionStatus::not_finite);
    system.linearize(d);
    const VectorXd first = d;
    contacts.begin();
    take_first_states();
    if (options.skip.cg && !options.is_static && (options.local || options.coarse)) {
      contacts.evaluate(d);
      if (solve_by_sweeps(system, options, contacts, d, report)) return settle();
      before_front = report.augmentations;
    }
    report.tolerance = options.residual_tolerance;
    if (options.warm_start) {  // the states of the forces that solve a problem that differs little
      near = true;
      contacts.evaluate(d);
      contacts.take_first_forces();
      contacts.take_states_of_forces();
      states = contacts.law_states();
    }
    evaluate();
    system.problem().contacts_changed();
    while (true) {
      if (!std::isfinite(report.residual.block_relative) || !std::isfinite(report.residual.largest))
        return end(SolutionStatus::not_finite);
      if (is_balanced() && (states_agree() || take_law(aim_of_states()))) {
        if (contacts.add_met(d)) {
          restart();
          continue;
        }
        if (contacts.are_close(d, 1, report.worst_contact)) {
          if (options.is_static && release_bonds()) continue;
          // Forces that differ from the law's by what does not count: inside the cone they are the law's.
          if (states != contacts.law_states()) take_law(options.residual_tolerance);
          return settle();
        }
        if (report.augmentations - before_front == options.max_augmentations)
          return end(SolutionStatus::penetrating);
        contacts.raise_multipliers(d);
        ++report.augmentations;
        restart();
        continue;
      }
      if (report.iterations < options.max_solutions && follow_states()) continue;
      if (std::exchange(leaves_open, true)) return end(failure);
      d = first;
      near = false;
      restart();
      take_first_states();
      evaluate_states();
    }
  }

  /// Those that the step before left.
  void take_first_states() {
    for (std::size_t c = 0; c < states.size(); ++c) {
      const Contact& contact = contacts.contacts()[c];
      states[c] = first_state(contact, contact.law.has_friction() || contacts.is_bonded(c));
    }
  }

  /// Geometry, terms, forces and residual at d.
  void evaluate() {
    contacts.evaluate(d);
    contacts.find_springs(d);
    evaluate_states();
  }

  /// The forces of the contacts in their states, how far they are off the law, and the residual.
  void evaluate_states() {
    for_all(states.size(), [&](std::size_t c) {
      const ContactForce force = contacts.forces()[c] = contacts.force_in(states[c], c),
                         law = contacts.law_force(c);
      off[c] = contacts.law_states()[c] == states[c] ||
                       (leaves_open && states[c] == none_acts && contacts.hardly_penetrates(c, d))
                   ? 0
                   : std::hypot(force.normal - law.normal, force.shear - law.shear);
    });
    compute_residual(contacts.forces(), report.residual);
    since_best = report.residual.block_relative < best ? 0 : since_best + 1;
    best = std::min(best, report.residual.block_relative);
  }

  void compute_residual(const std::vector<ContactForce>& forces, Residual& residual) const {
    system.compute_residual(d, contacts.contacts(), contacts.terms(), forces, residual);
  }

  bool is_balanced() const {
    const double own = report.residual.block_relative;
    if (own == 0 && report.residual.over_round_off > round_off_target && since_best < patience) return false;
    return own <= options.residual_aim || (own <= options.residual_tolerance && since_best >= patience);
  }

  /// Begins to look for a residual anew, from the law's states: what is to be balanced has changed.
  void restart() {
    states = contacts.law_states();
    begin_states();
    evaluate();
    acceleration.reset();
    interior_point_done = false;
  }

  /// Where all forces are round-off none of them counts.
  double negligible() const {
    const auto [scale, round_off] = std::pair(report.residual.scale, report.residual.round_off);
    return scale <= round_off ? round_off : negligible_force * scale;
  }
  int count_disagreeing() const {
    return static_cast<int>(std::ranges::count_if(off, [n = negligible()](double by) { return by > n; }));
  }
  bool states_agree() const { return count_disagreeing() == 0; }
  /// What the forces of the law may leave where they differ from those of the states: more when these have
  /// changed so often.
  double aim_of_states() const {
    return changes >= changes_until_accepted ? options.residual_tolerance : options.residual_aim;
  }

  /// The state to try next. Near a solution a contact that sticks while it is pulled slides before it opens:
  /// it may be its own friction that pulls.
  unsigned char next(std::size_t c) const {
    const unsigned char now = states[c], of_law = contacts.law_states()[c];
    if (near && now == all_act && of_law == none_acts)
      return normal_acts | (contacts.forces()[c].shear > 0 ? at_upper : at_lower);
    return next_state(now, of_law);
  }

  /// Gives every contact that disagrees its next state; when that has been seen before, the one that is
  /// furthest from its law. False: that too.
  bool change_states() {
    std::vector<unsigned char> all = states;
    std::size_t worst = 0;
    double furthest = 0;
    for (std::size_t c = 0; c < states.size(); ++c) {
      if (off[c] <= negligible()) continue;
      all[c] = next(c);
      if (off[c] > furthest) {
        furthest = off[c];
        worst = c;
      }
    }
    if (seen.contains(all))
      states[worst] = next(worst);
    else
      states = std::move(all);
    return seen.insert(states).second;
  }

  /// Takes the forces and states of the law at d if these leave balance to a tolerance too. False: they do
  /// not.
  bool take_law(double tolerance) {
    std::vector<ContactForce> forces(states.size());
    for (std::size_t c = 0; c < forces.size(); ++c) forces[c] = contacts.law_force(c);
    Residual residual;
    compute_residual(forces, residual);
    if (!(residual.block_relative <= tolerance)) return false;
    states = contacts.law_states();
    contacts.forces() = std::move(forces);
    std::ranges::fill(off, 0);
    report.residual = std::move(residual);
    return true;
  }

  /// Active-set iteration: solves for given states, then checks whether they agree with the solution.
  bool follow_states() {
    const bool solved = report.residual.block_relative <= sufficient_decrease * first_of_states ||
                        is_balanced() || solutions_of_states >= most_solutions_of_states;
    if (solutions_of_states > 0 && solved && !states_agree()) {
      if (changes == 0) first_disagreeing = count_disagreeing();
      if (++changes > most_changes || is_slow() || !change_states()) return leave_active_set();
      solutions_of_states = 0;
      best = inf;
      evaluate_states();
    }
    if (since_best > most_in_vain) return leave_active_set();
    if (solutions_of_states == 0 || report.residual.block_relative > kept_factor_gain * last_block_relative) {
      system.linearize(d);
      if (solutions_of_states == 0) acceleration.reset();
      if (solutions_of_states == 0) first_of_states = report.residual.block_relative;
    }
    last_block_relative = report.residual.block_relative;
    if (!system.problem().factorize(contacts.terms(), states, contacts.couplings(states)))
      return leave_active_set();
    system.problem().solve(report.residual.force, correction);
    VectorXd moved = d - correction;
    if (solutions_of_states >= first_accelerated)
      acceleration.advance(correction.cwiseProduct(system.unknown_lengths()), moved);
    if (!moved.allFinite()) return leave_active_set();
    system.move(moved - d, d);
    ++report.iterations;
    ++solutions_of_states;
    evaluate();
    return true;
  }

  /// Whether more contacts are in a wrong state than the interior-point method is worth.
  bool is_slow() const {
    return can_leave() && changes > changes_behind &&
           std::ldexp(count_disagreeing(), changes - 1 - changes_behind) > first_disagreeing;
  }
  bool can_leave() const { return !interior_point_done && options.interior_point; }

  void begin_states() {
    changes = solutions_of_states = since_best = 0;
    best = inf;
    seen.clear();
  }

  /// Leaves the active-set iteration for the interior-point method, once, which moves d and the states near
  /// to a solution. False: that was done before, or it failed.
  bool leave_active_set() {
    if (!can_leave()) return false;
    interior_point_done = near = true;
    ++report.interior_point_solves;
    d = system.prescribed();
    const InteriorReport found = find_interior_point_states(
        system, {contacts.contacts(), contacts.laws(), contacts.terms(), [this] { contacts.evaluate(d); }}, d,
        states);
    report.iterations += found.solutions;
    report.interior_solutions += found.solutions;
    begin_states();
    evaluate();
    system.problem().matrices_changed();  // the last factor has the stiffnesses of that method
    if (!found.found) failure = SolutionStatus::not_positive_definite;
    return found.found;
  }

  /// Breaks the bonds that yield within the step; false: none does.
  bool release_bonds() {
    if (!contacts.break_bonds(d)) return false;
    before_front = report.augmentations;
    restart();
    return true;
  }

  ContactSolverReport settle() {
    contacts.settle(negligible());
    contacts.break_bonds(d);
    return end(SolutionStatus::settled);
  }

  /// The contact with the largest force on the block that is furthest from balance; -1: it touches nothing.
  int find_unbalanced() const {
    int worst = -1;
    double largest = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const VertexEdge& pair = contacts.contacts()[c].pair;
      const double force = std::hypot(contacts.forces()[c].normal, contacts.forces()[c].shear);
      const bool touches_it =
          pair.vertex_block == report.residual.worst_block || pair.edge_block == report.residual.worst_block;
      if (!touches_it || force <= largest) continue;
      worst = static_cast<int>(c);
      largest = force;
    }
    return worst;
  }

  ContactSolverReport end(SolutionStatus status) {
    contacts.end(d);
    if (status == SolutionStatus::forces_unsettled) report.worst_contact = find_unbalanced();
    report.status = status;
    return std::move(report);
  }
};

}  // namespace

ContactSolverReport solve_contacts(StepProblem& system, const ContactSolverOptions& options,
                                   std::vector<Contact>& contacts, VectorXd& d) {
  return ContactSolver{system, options, {system, options, contacts}, d}.solve();
}

}  // namespace ddacontact
