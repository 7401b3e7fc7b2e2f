#include <ddacontact/solver/contact_solver.hpp>

#include <ddacontact/core/for_all.hpp>
#include <ddacontact/solver/anderson.hpp>
#include <ddacontact/solver/augmented_contacts.hpp>
#include <ddacontact/solver/interior_point.hpp>
#include <ddacontact/solver/swept_step.hpp>

#include <algorithm>
#include <cmath>
#include <set>

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
constexpr double stale_factor_gain = 0.1;
/// Solutions without a smaller residual after which an accepted one is final.
constexpr int patience = 4;
/// Residual target, as a fraction of the round-off bound.
constexpr double round_off_target = 0.05;

class ContactSolver {
 public:
  ContactSolver(StepSystem& system, const ContactSolverOptions& options, std::vector<Contact>& contacts,
                VectorXd& d)
      : system_(system),
        options_(options),
        contacts_(system, options, contacts),
        d_(d),
        states_(contacts.size()),
        off_(contacts.size()),
        tangent_(system.problem(), options.skip) {}

  ContactSolverReport solve() {
    if (!d_.allFinite()) return end(SolutionStatus::not_finite);
    system_.linearize(d_);
    contacts_.begin();
    for (std::size_t c = 0; c < states_.size(); ++c) {
      const Contact& contact = contacts_.contacts()[c];
      states_[c] = first_state(contact, contact.law.has_friction() || contacts_.is_bonded(c));
    }
    if (options_.skip.cg && !options_.is_static && (options_.local || options_.coarse)) {
      contacts_.evaluate(d_);
      if (solve_by_sweeps(system_, options_, contacts_, d_, report_)) return settle();
      before_front_ = report_.augmentations;
    }
    report_.tolerance = options_.residual_tolerance;
    if (options_.warm_start) {  // the states of the forces that solve a problem that differs little
      near_ = true;
      contacts_.evaluate(d_);
      contacts_.take_first_forces();
      contacts_.take_states_of_forces();
      states_ = contacts_.law_states();
    }
    look();
    system_.problem().contacts_changed();
    while (true) {
      if (!std::isfinite(report_.residual.block_relative) || !std::isfinite(report_.residual.largest))
        return end(SolutionStatus::not_finite);
      if (is_balanced() && (states_agree() || take_law(aim_of_states()))) {
        if (contacts_.are_close(d_, 1, report_.worst_contact)) {
          if (options_.is_static && release_bonds()) continue;
          // Forces that differ from the law's by what does not count: inside the cone they are the law's.
          if (states_ != contacts_.law_states()) take_law(options_.residual_tolerance);
          return settle();
        }
        if (report_.augmentations - before_front_ == options_.max_augmentations)
          return end(SolutionStatus::penetrating);
        contacts_.raise_multipliers(d_);
        ++report_.augmentations;
        restart();
        continue;
      }
      if (report_.iterations >= options_.max_solutions || !follow_states()) return end(failure_);
    }
  }

 private:
  /// Geometry, terms, forces and residual at d.
  void look() {
    contacts_.evaluate(d_);
    contacts_.find_springs(d_);
    evaluate_states();
  }

  /// The forces of the contacts in their states, how far they are off the law, and the residual.
  void evaluate_states() {
    for_all(states_.size(), [&](std::size_t c) {
      const ContactForce force = contacts_.forces()[c] = contacts_.force_in(states_[c], c),
                         law = contacts_.law_force(c);
      off_[c] = contacts_.law_states()[c] == states_[c]
                    ? 0
                    : std::hypot(force.normal - law.normal, force.shear - law.shear);
    });
    compute_residual(contacts_.forces(), report_.residual);
    since_best_ = report_.residual.block_relative < best_ ? 0 : since_best_ + 1;
    best_ = std::min(best_, report_.residual.block_relative);
  }

  void compute_residual(const std::vector<ContactForce>& forces, Residual& residual) const {
    system_.compute_residual(d_, contacts_.contacts(), contacts_.terms(), forces, residual);
  }

  bool is_balanced() const {
    const double own = report_.residual.block_relative;
    if (own == 0 && report_.residual.over_round_off > round_off_target && since_best_ < patience)
      return false;
    return own <= options_.residual_aim || (own <= options_.residual_tolerance && since_best_ >= patience);
  }

  /// Begins to look for a residual anew, from the law's states: what is to be balanced has changed.
  void restart() {
    states_ = contacts_.law_states();
    best_ = inf;
    since_best_ = 0;
    begin_states();
    look();
    acceleration_.reset();
    interior_point_done_ = false;
  }

  /// Where all forces are round-off none of them counts.
  double negligible() const {
    const auto [scale, round_off] = std::pair(report_.residual.scale, report_.residual.round_off);
    return scale <= round_off ? round_off : negligible_force * scale;
  }
  int count_disagreeing() const {
    const double counts = negligible();
    return static_cast<int>(std::ranges::count_if(off_, [&](double off) { return off > counts; }));
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
    const unsigned char now = states_[c], of_law = contacts_.law_states()[c];
    if (near_ && now == all_act && of_law == none_acts)
      return normal_acts | (contacts_.forces()[c].shear > 0 ? at_upper : at_lower);
    return next_state(now, of_law);
  }

  /// Gives every contact that disagrees its next state; when that has been seen before, the one that is
  /// furthest from its law. False: that too.
  bool change_states() {
    std::vector<unsigned char> all = states_;
    std::size_t worst = 0;
    double furthest = 0;
    for (std::size_t c = 0; c < states_.size(); ++c) {
      const double off = off_[c];
      if (off <= negligible()) continue;
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
    std::vector<ContactForce> forces(states_.size());
    for (std::size_t c = 0; c < forces.size(); ++c) forces[c] = contacts_.law_force(c);
    Residual residual;
    compute_residual(forces, residual);
    if (!(residual.block_relative <= tolerance)) return false;
    states_ = contacts_.law_states();
    contacts_.forces() = std::move(forces);
    std::ranges::fill(off_, 0);
    report_.residual = std::move(residual);
    return true;
  }

  /// Active-set iteration: solves for given states, then checks whether they agree with the solution.
  bool follow_states() {
    const bool solved = report_.residual.block_relative <= sufficient_decrease * first_of_states_ ||
                        is_balanced() || solutions_of_states_ >= most_solutions_of_states;
    if (solutions_of_states_ > 0 && solved && !states_agree()) {
      if (changes_ == 0) first_disagreeing_ = count_disagreeing();
      if (++changes_ > most_changes || is_slow() || !change_states()) return leave_active_set();
      solutions_of_states_ = 0;
      best_ = inf;
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
    for (std::size_t c = 0; c < states_.size(); ++c) active[c] = states_[c] & all_act;
    if (!tangent_.solve(contacts_.terms(), active, contacts_.couplings(states_), report_.residual.force,
                        correction_))
      return leave_active_set();
    VectorXd next = d_;
    if (solutions_of_states_ >= first_accelerated)
      acceleration_.advance(-correction_, system_.unknown_lengths(), next);
    else
      next -= correction_;
    if (!next.allFinite()) return leave_active_set();
    system_.move(next - d_, d_);
    ++report_.iterations;
    ++solutions_of_states_;
    look();
    return true;
  }

  /// Whether more contacts are in a wrong state than the interior-point method is worth.
  bool is_slow() const {
    return can_leave() && changes_ > changes_behind &&
           std::ldexp(count_disagreeing(), changes_ - 1 - changes_behind) > first_disagreeing_;
  }
  bool can_leave() const { return !interior_point_done_ && options_.interior_point; }

  void begin_states() {
    changes_ = solutions_of_states_ = 0;
    seen_.clear();
  }

  /// Leaves the active-set iteration for the interior-point method, once, which moves d and the states near
  /// to a solution. False: that was done before, or it failed.
  bool leave_active_set() {
    if (!can_leave()) return false;
    interior_point_done_ = near_ = true;
    ++report_.interior_point_solves;
    d_ = system_.prescribed();
    const InteriorReport found = find_interior_point_states(
        system_, contacts_.contacts(), contacts_.laws(), [this] { contacts_.evaluate(d_); },
        contacts_.terms(), d_, states_);
    report_.iterations += found.solutions;
    report_.interior_solutions += found.solutions;
    report_.tangent.fallbacks += found.fallbacks;
    begin_states();
    best_ = inf;
    since_best_ = 0;
    look();
    if (!found.found) failure_ = SolutionStatus::not_positive_definite;
    return found.found;
  }

  /// Breaks the bonds that yield within the step; false: none does.
  bool release_bonds() {
    if (!contacts_.break_bonds(d_)) return false;
    contacts_.drop_broken_bonds();
    before_front_ = report_.augmentations;
    restart();
    return true;
  }

  ContactSolverReport settle() {
    contacts_.settle(negligible());
    contacts_.break_bonds(d_);
    return end(SolutionStatus::settled);
  }

  /// The contact with the largest force on the block that is furthest from balance; -1: it touches nothing.
  int find_unbalanced() const {
    int worst = -1;
    double largest = 0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const VertexEdge& pair = contacts_.contacts()[c].pair;
      const double force = std::hypot(contacts_.forces()[c].normal, contacts_.forces()[c].shear);
      const bool touches_it = pair.vertex_block == report_.residual.worst_block ||
                              pair.edge_block == report_.residual.worst_block;
      if (!touches_it || force <= largest) continue;
      worst = static_cast<int>(c);
      largest = force;
    }
    return worst;
  }

  ContactSolverReport end(SolutionStatus status) {
    contacts_.end(d_);
    if (status == SolutionStatus::forces_unsettled) report_.worst_contact = find_unbalanced();
    report_.status = status;
    report_.tangent += tangent_.counts();
    return std::move(report_);
  }

  StepSystem& system_;
  const ContactSolverOptions& options_;
  AugmentedContacts contacts_;
  VectorXd& d_;
  std::vector<unsigned char> states_;  ///< the active set
  std::vector<double> off_;            ///< the force by which the law differs from the springs of the state
  ContactSolverReport report_;
  int before_front_ = 0;  ///< augmentations by sweeps, and before bonds broke last
  double best_ = inf;
  int since_best_ = 0;

  SolutionStatus failure_ = SolutionStatus::forces_unsettled;  ///< how to end when nothing is left to try
  std::set<std::vector<unsigned char>> seen_;
  int changes_ = 0, solutions_of_states_ = 0;
  int first_disagreeing_ = 0;         ///< contacts, before the first change
  bool interior_point_done_ = false;  ///< the states were found by the interior-point method
  bool near_ = false;                 ///< a solution is near: by that method or a warm start
  double last_block_relative_ = inf, first_of_states_ = inf;
  TangentSolver tangent_;
  AndersonAcceleration acceleration_;
  VectorXd correction_;
};

}  // namespace

ContactSolverReport solve_contacts(StepSystem& system, const ContactSolverOptions& options,
                                   std::vector<Contact>& contacts, VectorXd& d) {
  return ContactSolver(system, options, contacts, d).solve();
}

}  // namespace ddacontact
