// What an accepted step leaves: its accounts, and what the next step carries on.
#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/core/quoted.hpp>
#include <ddacontact/time/energy_accounts.hpp>
#include <ddacontact/time/joint_springs.hpp>
#include <ddacontact/time/stepper.hpp>
#include <ddacontact/time/trial_accounts.hpp>

#include <algorithm>
#include <cassert>
#include <new>

namespace ddacontact {

void Stepper::accept(double dt, const TrialSolution& solution, TrialEnd end) {
  assert(end.state.time > state_now().time && dt > 0);
  accepting_ = true;
  BlockState& next = end.state;
  record_reactions(solution.straight, solution.residual);
  const AcceptedTrial accepted{blocks_now(), state_now(), trial_, solution};
  account(accepted, run_.energy.now);
  run_.energy.now.numerical_dissipated +=
      lost_by_joints(trial_.builder().properties(), contacts_, trial_.contacts());
  for (const std::string& bolt : end_bolts(accepted, next, run_.energy.now))
    run_.notes.push_back("bolt " + quoted(bolt) + " has torn at time " + std::to_string(next.time) + " s");
  assess(dt, solution, next);
  book_kinetic(kinetic_energy(blocks_now(), next.velocity), run_.energy.now);
  const ContactEnds ends = end_histories(blocks_now(), next, trial_.system().rule(),
                                         trial_.builder().properties(), trial_.contacts(), run_.energy.now);
  account_impact(solution.impact, run_.energy.now);
  note_concave(end.concave, next.time);
  contacts_.assign(trial_.contacts().begin(), trial_.contacts().end());
  state_now() = std::move(next);
  reshape_and_keep_momentum();
  run_.energy.now.kinetic = kinetic_energy(blocks_now(), state_now().velocity);
  run_.energy.now.elastic =
      elastic_energy(blocks_now(), state_now(), contacts_, trial_.builder().properties()) +
      sleepers_.elastic_energy();
  const bool some_fell_asleep = sleepers_.fall_asleep(dt);
  if (some_fell_asleep) book_kinetic(kinetic_energy(blocks_now(), state_now().velocity), run_.energy.now);
  tolerated_work_ = 0;
  for (const Contact& contact : trial_.contacts())
    tolerated_work_ += std::max(contact.normal, 0.0) * trial_.options().penetration_tolerance * contact.size;
  count(solution, ends);
  begun_ = true;
  run_.last_dt = dt;
  detected_ = false;
  margin_scale_ = 1;
  sleepers_.contacts_changed();
  run_.counts.equations = blocks_now().n_equations();
  if (some_fell_asleep) sleepers_.regroup();
  run_.counts.asleep = sleepers_.n_asleep();
  accepting_ = false;
}

void Stepper::count(const TrialSolution& solution, const ContactEnds& ends) {
  ++run_.counts.substeps;
  run_.counts.impacts += solution.impact.n_hits;
  if (solution.impact.limited) ++run_.counts.limited_impacts;
  if (!solution.impact.settled) ++run_.counts.unsettled_impacts;
  run_.counts.broken_bonds += ends.broken_bonds;
  run_.counts.contacts = ends.closed + sleepers_.n_closed();
  run_.counts.contacts_max = std::max(run_.counts.contacts_max, run_.counts.contacts);
  run_.counts.max_penetration = std::max(run_.counts.max_penetration, ends.deepest);
  run_.counts.max_residual = std::max(run_.counts.max_residual, solution.residual.block_relative);
  run_.counts.largest_tolerance = std::max(run_.counts.largest_tolerance, solution.tolerance);
}

/// Outlines that are convex no more, which is told once.
void Stepper::note_concave(const std::vector<int>& concave, double time) {
  for (int b : concave) {
    if (!run_.convex[sleepers_.in_whole(b)]) continue;
    run_.convex[sleepers_.in_whole(b)] = false;
    run_.notes.push_back("block " + quoted(blocks_now().names[b]) + " is no longer convex at time " +
                         std::to_string(time) + " s: it goes on with " +
                         (analysis_.kinematics == Kinematics::corotational
                              ? "the functions of its starting shape"
                              : "mean value functions while a corner is concave"));
  }
}

void Stepper::look_ahead(long steps_made) {
  if (state_now().carried_dt > 0) {
    try {
      for (bool cut = true; cut;) {
        const Substep next = next_substep(steps_made);
        ahead_ = Ahead{next.dt, find_solution(next.dt), run_.counts, substep_};
        cut = refuses(ahead_->solution, next.dt) && !next.is_shortest;
        if (!cut) continue;
        ++run_.counts.rejected;
        substep_ = next.dt * analysis_.cutting_factor;
      }
      ahead_->solution.start.resize(0);  // has served
    } catch (const std::bad_alloc&) {    // the step itself will say so
      discard_trials();
    }
    run_.counts = accepted_.counts;
    substep_ = accepted_.substep;
    if (ahead_ && !refuses(ahead_->solution, ahead_->dt)) {
      const double dt = ahead_->dt;
      const TrialSolution& solution = ahead_->solution;
      // The forces of the next substep act at the present time, without those of an impact to come.
      if (!solution.impact.changes()) record_reactions(solution.straight, solution.residual);
      VectorXd next = solution.straight / dt;
      if (solution.impact.changes()) next -= solution.impact.jump;
      state_now().velocity =
          (dt * state_now().carried + state_now().carried_dt * next) / (dt + state_now().carried_dt);
      for (const auto& [b, acceleration] : solution.impact.acceleration_before) {
        const Range& u = blocks_now().block(b).unknowns();
        u.of(state_now().velocity) = u.of(state_now().carried) + state_now().carried_dt / 2 * acceleration;
      }
      // Central differences keep the energy less (v - v_before) M (v - v_before) / 8.
      if (stable_)
        tolerated_work_ += kinetic_energy(blocks_now(), solution.straight / dt - state_now().carried) / 4;
      book_kinetic(kinetic_energy(blocks_now(), state_now().velocity), run_.energy.now);
    } else {
      accepted_.counts.unknown_velocities = ++run_.counts.unknown_velocities;
      if (ahead_) ++ahead_->counts.unknown_velocities;
    }
  }
  run_.energy.close_step(tolerated_work_);
}

void Stepper::assess(double dt, const TrialSolution& solution, const BlockState& next) {
  const Points& reactions = sleepers_.n_asleep() > 0 ? reactions_of_step_ : run_.reactions;
  const VectorXd velocity = is_static() ? solution.d / dt : next.velocity;
  const double before = run_.equilibrium.unbalanced;
  run_.equilibrium =
      find_equilibrium(trial_.system(), solution, trial_.contacts(), state_now(), reactions, velocity);
  for (int* b : {&run_.equilibrium.unbalanced_block, &run_.equilibrium.fastest_block})
    if (*b >= 0) *b = sleepers_.in_whole(*b);
  run_.equilibrium.unbalanced_before = before;
  run_.warnings.note({.blocks = blocks_now(),
                      .state = next,
                      .d = solution.d,
                      .contacts = trial_.contacts(),
                      .dt = dt,
                      .time = state_now().time + dt,
                      .has_velocities = !is_static(),
                      .is_first = !begun_,
                      .in_whole = sleepers_.in_whole()});
}

void Stepper::reshape_and_keep_momentum() {
  if (analysis_.preset == Preset::paper || analysis_.kinematics == Kinematics::corotational || is_static()) {
    blocks_now().reshape(state_now());
    return;
  }
  Points before(2, blocks_now().n_blocks());
  for (int b = 0; b < blocks_now().n_blocks(); ++b)
    before.col(b) = rigid_velocity(blocks_now().block(b), state_now(), state_now().velocity).linear;
  blocks_now().reshape(state_now());
  for (int b = 0; b < blocks_now().n_blocks(); ++b) {
    if (!blocks_now().is_free(b)) continue;
    const Block& block = blocks_now().block(b);
    const Vec2 lost = before.col(b) - rigid_velocity(block, state_now(), state_now().velocity).linear;
    block.unknowns().of(state_now().velocity) += block.translations() * lost;
  }
}

void Stepper::record_reactions(const VectorXd& d, const Residual& residual) {
  Points& reactions = sleepers_.n_asleep() > 0 ? reactions_of_step_ : run_.reactions;
  reactions.setZero(2, state_now().position.cols());
  for (const PrescribedDof& held : blocks_now().prescribed_dofs())
    reactions(held.axis, held.vertex) += residual.force[held.unknown];
  for (const StepSystem::FixedPointSpring& spring : trial_.system().fixed_point_springs()) {
    const FixedVertex& held = blocks_now().fixed_vertices[spring.fixed_vertex];
    reactions(spring.axis, blocks_now().block(held.block).vertices().first + held.vertex) -=
        trial_.system().fixed_point_stiffness() * spring.form(d);
  }
  if (sleepers_.n_asleep() > 0) sleepers_.spread_reactions(reactions, run_.reactions);
}

}  // namespace ddacontact
