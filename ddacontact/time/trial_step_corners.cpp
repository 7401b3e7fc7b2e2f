// Which lines corners meet, by the motion of the step itself.
#include <ddacontact/contact/contacts_by_pair.hpp>
#include <ddacontact/time/trial_step.hpp>

namespace ddacontact {

TrialSolution TrialStep::solve_without(const std::vector<int>& doubtful, double dt,
                                       const TrialSolution& with) {
  restart();
  const std::vector<Contact> all = contacts_;
  for (auto c = doubtful.rbegin(); c != doubtful.rend(); ++c) contacts_.erase(contacts_.begin() + *c);
  TrialSolution without = solve_with_impacts(dt, &with);
  contacts_ = all;
  solved_ = false;
  return without;
}

TrialSolution TrialStep::solve(double dt) {
  TrialSolution solution = solve_with_impacts(dt);
  if (analysis_.preset == Preset::paper) return solution;
  for (int round = 0; builder_->has_choices() && solution.rejection.empty(); ++round) {
    const std::vector<int> doubtful =
        builder_->find_doubtful(contacts_, options_.sweep_tolerance * solution.residual.scale, doubts_);
    const std::vector<Contact> solved = contacts_;
    bool changed = false;
    if (doubtful.empty()) {
      restart();
      changed = builder_->choose_again(state(), solution.motion(), last_, contacts_);
    } else {
      const TrialSolution without = solve_without(doubtful, dt, solution);
      if (without.rejection.empty()) {
        ++counts_.corner_solutions;
        changed = builder_->decide_doubtful(state(), without.motion(), last_, contacts_);
      }
      const StepImpact& impact = solution.impact;
      if (impact.changes() || without.impact.changes()) {  // the step of the solution, not that without
        const BlockState& from = impact.changes() ? impact.start : state();
        system_->set_step(from, step_from(analysis_, from, dt), builder_->properties().normal_stiffness);
      }
    }
    if (changed && round == most_rounds) ++counts_.unsettled_corners;
    if (!changed || round == most_rounds) {
      contacts_ = solved;
      solved_ = true;
      break;
    }
    keep_start();
    solution = solve_with_impacts(dt, &solution);
    ++counts_.corner_solutions;
  }
  return solution;
}

}  // namespace ddacontact
