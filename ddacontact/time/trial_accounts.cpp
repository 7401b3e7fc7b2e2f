#include <ddacontact/time/trial_accounts.hpp>

#include <ddacontact/equations/bolt_law.hpp>
#include <ddacontact/time/energy_accounts.hpp>
#include <ddacontact/time/motion_accounts.hpp>

namespace ddacontact {

namespace {

/// What weight and loads work where an impact shifts the start of the step.
void book_shift(const StepSystem& system, const VectorXd& shift, Energy& energy) {
  const double by_weight = system.gravity_forces().dot(shift), by_loads = system.load_forces().dot(shift);
  energy.gravity -= by_weight;
  energy.external += by_loads;
  energy.numerical_dissipated += by_weight + by_loads;
}

/// With an impact: how the motion of the step changed gaps and slips, in the directions of the contacts'
/// forces.
/// \param[in] from  where the step was computed from
void measure_contacts(const VectorXd& d, const VectorXd& motion, TrialStep& trial) {
  for (Contact& contact : trial.contacts()) {
    if (contact.normal == 0 && contact.shear == 0) continue;
    const GapAndSlip at_d =
        contact.motion.gap_and_slip_at(d, contact.history.lock, trial.system().rule().directions());
    contact.gap_change = contact.motion.change_along(at_d.by_gap, motion);
    contact.slip_change = contact.motion.change_along(at_d.by_slip, motion);
  }
}

}  // namespace

void account(const AcceptedTrial& accepted, Energy& energy) {
  const auto& [blocks, before, trial, solution] = accepted;
  const StepImpact& impact = solution.impact;
  const BlockState& from = impact.changes() ? impact.start : before;
  const VectorXd motion = accepted.motion();
  if (impact.changes()) trial.builder().start_from(from, trial.contacts());
  energy.gravity -= trial.system().gravity_forces().dot(motion);
  energy.external += trial.system().load_forces().dot(motion);
  if (!blocks.quiet_faces.empty())
    energy.damping_dissipated -= trial.system().quiet_forces(solution.straight).dot(motion);
  if (trial.system().rule().has_half_steps()) {
    account_motion_step(trial.system(), from, solution.straight, solution.residual, trial.contacts(), energy);
    if (impact.changes()) book_shift(trial.system(), impact.shift, energy);
  } else {
    if (impact.changes()) measure_contacts(solution.d, motion, trial);
    account_step(trial.system(), solution, motion, trial.contacts(), trial.builder().properties(), energy);
  }
}

std::vector<std::string> end_bolts(const AcceptedTrial& accepted, BlockState& next, Energy& energy) {
  const auto& [blocks, before, trial, solution] = accepted;
  const std::vector<StepBolt>& bolts = trial.system().bolts_at(solution.straight);
  if (bolts.empty()) return {};
  std::vector<std::string> torn;
  double dissipated = 0;
  for (const StepBolt& bolt : bolts) {
    const BoltLosses losses = bolt.end(next.bolts);
    dissipated += losses.dissipated;
    if (losses.tears) torn.push_back(bolt.bolt().name);
  }
  energy.plastic_dissipated += dissipated;
  energy.numerical_dissipated += bolt_energy(blocks, before) - bolt_energy(blocks, next) - dissipated -
                                 trial.system().bolt_forces(solution.straight).dot(accepted.motion());
  return torn;
}

void account_impact(const StepImpact& impact, Energy& energy) {
  energy.numerical_dissipated += impact.support_work;
  energy.external += impact.support_work;
  account_losses(impact.normal_loss, impact.friction_loss, energy);
}

void book_kinetic(double kinetic, Energy& energy) {
  energy.numerical_dissipated -= kinetic - energy.kinetic;
  energy.kinetic = kinetic;
}

}  // namespace ddacontact
