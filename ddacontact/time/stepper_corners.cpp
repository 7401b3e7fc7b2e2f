// Which lines corners meet, by the motion of the step itself.
#include <ddacontact/time/step_from.hpp>
#include <ddacontact/time/stepper.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

/// A step is solved so often for lines that turn out to be others.
constexpr int most_corner_rounds = 4;

/// Those that contacts had, by the pairs that are still among them; both lists are in the order of the pairs
/// of blocks.
std::vector<ContactForce> forces_still_there(const std::vector<Contact>& had,
                                             const std::vector<Contact>& now) {
  std::vector<ContactForce> forces(now.size());
  const auto blocks_of = [](const VertexEdge& pair) {
    return std::minmax(pair.vertex_block, pair.edge_block);
  };
  std::size_t from = 0;
  for (std::size_t c = 0; c < now.size(); ++c) {
    while (from < had.size() && blocks_of(had[from].pair) < blocks_of(now[c].pair)) ++from;
    for (std::size_t k = from; k < had.size() && blocks_of(had[k].pair) == blocks_of(now[c].pair); ++k)
      if (had[k].pair == now[c].pair) forces[c] = {had[k].normal, had[k].shear};
  }
  return forces;
}

}  // namespace

VectorXd Stepper::predicted_motion(double dt) const {
  const bool at_rest = is_static() || analysis_.preset == Preset::paper;
  VectorXd d = at_rest ? VectorXd::Zero(state_.velocity.size()) : VectorXd(dt * state_.going_on());
  if (analysis_.preset == Preset::paper || blocks_.prescribed_dofs().empty()) return d;
  const VectorXd prescribed = blocks_.prescribed(state_, state_.time + dt);
  for (const PrescribedDof& held : blocks_.prescribed_dofs()) d[held.unknown] = prescribed[held.unknown];
  return d;
}

VectorXd Stepper::motion_of(const Solution& solution) {
  return solution.impact.changes() ? VectorXd(solution.d + solution.impact.shift) : solution.d;
}

Stepper::Solution Stepper::solve_without(const std::vector<int>& doubtful, double dt, Solution& with) {
  with.forces = trial_forces();
  restart_contacts();
  const std::vector<Contact> all = trial_contacts_;
  for (auto c = doubtful.rbegin(); c != doubtful.rend(); ++c) {
    trial_contacts_.erase(trial_contacts_.begin() + *c);
    with.forces.erase(with.forces.begin() + *c);
  }
  Solution without = solve(dt, &with);
  trial_contacts_ = all;
  trials_changed_ = false;
  return without;
}

Stepper::Solution Stepper::solve_with_corners(double dt) {
  Solution solution = solve(dt);
  if (analysis_.preset == Preset::paper) return solution;
  for (int round = 0; contact_builder_->has_choices() && solution.rejection.empty(); ++round) {
    const std::vector<Contact> solved = trial_contacts_;
    const std::vector<int> doubtful = contact_builder_->find_doubtful(
        trial_contacts_, solver_options_.residual_tolerance * solution.residual.scale);
    bool changed = false;
    if (doubtful.empty()) {
      restart_contacts();
      changed = contact_builder_->choose_again(state_, motion_of(solution), contacts_, trial_contacts_);
    } else {
      const Solution without = solve_without(doubtful, dt, solution);
      if (without.rejection.empty()) {
        ++counts_.corner_solutions;
        changed = contact_builder_->decide_doubtful(state_, motion_of(without), contacts_, trial_contacts_);
      }
      const StepImpact& impact = solution.impact;
      if (impact.changes() || without.impact.changes()) {  // the step of the solution, not that without
        const BlockState& from = impact.changes() ? impact.start : state_;
        blocks_.prepare(from);
        system_->set_step(from, step_from(analysis_, from, dt, state_.carried_dt), fixed_point_stiffness_);
        blocks_.prepare(state_);
      }
    }
    if (changed && round == most_corner_rounds) ++counts_.unsettled_corners;
    if (!changed || round == most_corner_rounds) {
      trial_contacts_ = solved;
      trials_changed_ = true;
      break;
    }
    keep_start();
    solution.forces = forces_still_there(solved, trial_contacts_);
    solution = solve(dt, &solution);
    ++counts_.corner_solutions;
  }
  return solution;
}

}  // namespace ddacontact
