// What an accepted step leaves: its accounts, and what the next step carries on.
#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/core/quoted.hpp>
#include <ddacontact/time/energy_accounts.hpp>
#include <ddacontact/time/joint_springs.hpp>
#include <ddacontact/time/stepper.hpp>
#include <ddacontact/time/trial_accounts.hpp>

#include <algorithm>
#include <new>

namespace ddacontact {

void Stepper::accept(double dt, const TrialSolution& solution, TrialEnd end) {
  accepting_ = true;
  BlockState& next = end.state;
  record_reactions(solution.straight, solution.residual);
  const AcceptedTrial accepted{blocks_, state_, trial_, solution};
  account(accepted, energy_.now);
  energy_.now.numerical_dissipated +=
      lost_by_joints(trial_.builder().properties(), contacts_, trial_.contacts());
  for (const std::string& bolt : end_bolts(accepted, next, energy_.now))
    notes_.push_back("bolt " + quoted(bolt) + " has torn at time " + std::to_string(next.time) + " s");
  assess(dt, solution, next);
  book_kinetic(kinetic_energy(blocks_, next.velocity), energy_.now);
  const ContactEnds ends =
      end_histories(trial_.builder().properties(), is_static(), trial_.system().rule().mean_forces(),
                    trial_.contacts(), energy_.now);
  account_impact(solution.impact, energy_.now);
  note_concave(end.concave, next.time);
  contacts_.assign(trial_.contacts().begin(), trial_.contacts().end());
  state_ = std::move(next);
  prepare_and_keep_momentum();
  energy_.now.kinetic = kinetic_energy(blocks_, state_.velocity);
  energy_.now.elastic =
      elastic_energy(blocks_, state_, contacts_, trial_.builder().properties()) + sleepers_.elastic_energy();
  const bool some_fell_asleep = sleepers_.fall_asleep(dt);
  if (some_fell_asleep) book_kinetic(kinetic_energy(blocks_, state_.velocity), energy_.now);
  tolerated_work_ = 0;
  for (const Contact& contact : trial_.contacts())
    tolerated_work_ += std::max(contact.normal, 0.0) * trial_.options().penetration_tolerance * contact.size;
  count(solution, ends);
  begun_ = true;
  last_dt_ = dt;
  detected_ = false;
  reach_scale_ = 1;
  sleepers_.contacts_changed();
  counts_.equations = blocks_.n_equations();
  if (some_fell_asleep) sleepers_.regroup();
  counts_.asleep = sleepers_.n_asleep();
  accepting_ = false;
}

void Stepper::count(const TrialSolution& solution, const ContactEnds& ends) {
  ++counts_.substeps;
  counts_.impacts += solution.impact.n_hits;
  if (solution.impact.limited) ++counts_.limited_impacts;
  if (!solution.impact.settled) ++counts_.unsettled_impacts;
  counts_.broken_bonds += ends.broken_bonds;
  counts_.contacts = ends.closed + sleepers_.n_closed();
  counts_.contacts_max = std::max(counts_.contacts_max, counts_.contacts);
  counts_.max_penetration = std::max(counts_.max_penetration, ends.deepest);
  counts_.max_residual = std::max(counts_.max_residual, solution.residual.block_relative);
  counts_.largest_tolerance = std::max(counts_.largest_tolerance, solution.tolerance);
}

/// Outlines that are convex no more, which is told once.
void Stepper::note_concave(const std::vector<int>& concave, double time) {
  for (int b : concave) {
    if (!convex_[sleepers_.in_whole(b)]) continue;
    convex_[sleepers_.in_whole(b)] = false;
    notes_.push_back("block " + quoted(blocks_.names[b]) + " is no longer convex at time " +
                     std::to_string(time) + " s: it goes on with " +
                     (analysis_.kinematics == Kinematics::corotational
                          ? "the functions of its starting shape"
                          : "mean value functions while a corner is concave"));
  }
}

void Stepper::look_ahead(double dt) {
  if (state_.carried_dt > 0) {
    try {
      ahead_ = Ahead{dt, find_solution(dt), counts_};
      ahead_->solution.start.resize(0);  // has served
    } catch (const std::bad_alloc&) {    // the step itself will say so
      discard_trials();
    }
    counts_ = accepted_.counts;
    if (ahead_ && (ahead_->solution.rejection.empty() || ahead_->solution.friction_unsettled)) {
      const TrialSolution& solution = ahead_->solution;
      const VectorXd next = without_impact(blocks_, state_, solution.impact, solution.straight / dt);
      state_.velocity = (dt * state_.carried + state_.carried_dt * next) / (dt + state_.carried_dt);
      // Central differences keep the energy less (v - v_before) M (v - v_before) / 8.
      if (stable_) tolerated_work_ += kinetic_energy(blocks_, solution.straight / dt - state_.carried) / 4;
      book_kinetic(kinetic_energy(blocks_, state_.velocity), energy_.now);
    } else {
      accepted_.counts.unknown_velocities = ++counts_.unknown_velocities;
      if (ahead_) ++ahead_->counts.unknown_velocities;
    }
  }
  energy_.close_step(tolerated_work_);
}

void Stepper::assess(double dt, const TrialSolution& solution, const BlockState& next) {
  const Points& reactions = sleepers_.n_asleep() > 0 ? reactions_of_step_ : reactions_;
  const VectorXd velocity = is_static() ? solution.d / dt : next.velocity;
  const double before = equilibrium_.unbalanced;
  equilibrium_ = has_motions()
                     ? find_equilibrium(blocks_, sum_forces(trial_.system(), solution.straight, reactions),
                                        trial_.contacts(), velocity)
                     : find_equilibrium(blocks_, trial_.system(), solution.residual, trial_.contacts(),
                                        reactions, velocity);
  for (int* b : {&equilibrium_.unbalanced_block, &equilibrium_.fastest_block})
    if (*b >= 0) *b = sleepers_.in_whole(*b);
  equilibrium_.unbalanced_before = before;
  warnings_.look({.blocks = blocks_,
                  .state = next,
                  .d = solution.d,
                  .contacts = trial_.contacts(),
                  .dt = dt,
                  .time = state_.time + dt,
                  .has_velocities = !is_static(),
                  .is_first = !begun_,
                  .in_whole = sleepers_.in_whole()});
}

void Stepper::prepare_and_keep_momentum() {
  if (analysis_.preset == Preset::paper || analysis_.kinematics == Kinematics::corotational || is_static()) {
    blocks_.prepare(state_);
    return;
  }
  Points before(2, blocks_.n_blocks());
  for (int b = 0; b < blocks_.n_blocks(); ++b)
    before.col(b) = rigid_velocity(blocks_.block(b), state_.velocity).linear;
  blocks_.prepare(state_);
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (!blocks_.is_free(b)) continue;
    const Block& block = blocks_.block(b);
    const Vec2 lost = before.col(b) - rigid_velocity(block, state_.velocity).linear;
    state_.velocity.segment(block.unknowns().first, block.unknowns().count) += block.translations() * lost;
  }
}

void Stepper::record_reactions(const VectorXd& d, const Residual& residual) {
  Points& reactions = sleepers_.n_asleep() > 0 ? reactions_of_step_ : reactions_;
  reactions.setZero(2, state_.position.cols());
  for (const PrescribedDof& held : blocks_.prescribed_dofs())
    reactions(held.axis, held.vertex) += residual.force[held.unknown];
  for (const StepSystem::FixedPointSpring& spring : trial_.system().fixed_point_springs()) {
    const FixedVertex& held = blocks_.fixed_vertices[spring.fixed_vertex];
    reactions(spring.axis, blocks_.block(held.block).vertices().first + held.vertex) -=
        trial_.system().fixed_point_stiffness() * spring.form(d);
  }
  if (sleepers_.n_asleep() > 0) sleepers_.spread_reactions(reactions, reactions_);
}

}  // namespace ddacontact
