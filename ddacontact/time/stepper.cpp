#include <ddacontact/time/stepper.hpp>

#include <ddacontact/contact/contacts_by_pair.hpp>
#include <ddacontact/core/quoted.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/time/driven_blocks.hpp>
#include <polyfem/core/out_of_memory.hpp>
#include <polyfem/core/stopwatch.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

/// A substep shorter than this times the longest one is not tried.
constexpr double shortest_substep = 1e-3;
/// From this times the longest one on, a substep is accepted with unsettled stick and slip, and counted.
constexpr double tolerant_substep = 1e-2;
/// A block that moved further than its contacts were looked for has them looked for this much further.
constexpr double margin_growth = 4;

/// The length of a step without the round-off of the times that it lies between: what was made for the step
/// before serves again.
double without_round_off(double dt, double time_step, double time) {
  const double whole_part = time_step / std::round(time_step / dt);
  return std::abs(dt - whole_part) <= few_ulps * std::abs(time) ? whole_part : dt;
}

}  // namespace

bool Stepper::step() {
  const bool more_stages = progress_.stage + 1 < static_cast<int>(stages_.size());
  if (more_stages && (progress_.steps == analysis_.steps || progress_.came_to_rest) &&
      !enter_stage(progress_.stage + 1))
    return false;
  bool made = false;
  {
    const SleepingBlocks::WhileStepping while_stepping(sleepers_);
    made = make_substeps();
    sleepers_.write();
  }
  if (!made) return false;
  const std::optional<RestCriterion>& until = stages_[progress_.stage].until;
  const auto changed = [&](const TimeFunction* function) {
    return function->changes_between(state_.time - analysis_.time_step, state_.time, blocks_.end_time);
  };
  const bool comes_to_rest = !progress_.came_to_rest && until && state_.time >= blocks_.fading.to &&
                             run_.equilibrium.meets(*until, run_.energy.exchanged()) &&
                             std::ranges::none_of(blocks_.time_functions(), changed);
  if (comes_to_rest) progress_.came_to_rest = true;
  if (++progress_.steps == analysis_.steps || comes_to_rest) leave_stage();
  return true;
}

Stepper::Substep Stepper::next_substep(long steps_made) {
  const double end = progress_.start_time() + static_cast<double>(steps_made + 1) * analysis_.time_step;
  const double remaining = end - state_now().time;
  const double wanted = std::min(substep_, limits_.predicted_step(blocks_now(), state_now(), contacts_));
  const double shortest = shortest_substep * longest_substep();
  constexpr double round_off = std::numeric_limits<float>::epsilon();
  const double pieces = std::max(1.0, std::ceil(remaining / std::max(wanted, shortest) - round_off));
  const double dt = without_round_off(remaining / pieces, analysis_.time_step, end);
  return {dt, end, pieces <= 1, dt * analysis_.cutting_factor < shortest};
}

double Stepper::longest_substep() const {
  return stable_ ? stable_->dt : analysis_.time_step;
}

bool Stepper::make_substeps() {
  while (true) {
    if (ahead_) substep_ = ahead_->substep;
    const auto [dt, end, is_last, is_shortest] = next_substep(progress_.steps);
    Trial result;
    try {
      result = make_trial(dt);
      if (result == Trial::accepted) {
        substep_ = std::min(longest_substep(), std::max(substep_, 2 * dt));
        if (is_last) {
          state_now().time = end;
          ++run_.counts.steps;
        }
        accepted_ = {substep_, run_.counts};
        sleepers_.accept();
        look_ahead(progress_.steps + is_last);
        sleepers_.accept();  // who sleeps after it is what a record holds
        if (is_last) return true;
        if (is_interrupted()) return false;
        continue;
      }
    } catch (const std::bad_alloc& error) {
      if (accepting_) throw;
      discard_trials();
      stop_reason_ = dynamic_cast<const polyfem::OutOfMemory*>(&error)
                         ? error.what()
                         : "out of memory with " + std::to_string(blocks_now().n_equations()) +
                               " unknowns and " + std::to_string(trial_.contacts().size()) + " contacts";
      return false;
    }
    ++run_.counts.rejected;
    if (is_interrupted()) return false;
    run_.counts.overlap_rejections += result == Trial::missed_contacts;
    if (result == Trial::woke_blocks || result == Trial::missed_contacts) continue;
    if (result == Trial::outran_detection) {
      margin_scale_ *= margin_growth;
      detected_ = false;
      continue;
    }
    if (is_shortest) {
      stop_reason_ =
          rejection_ + ", even with a substep of " + std::to_string(dt / analysis_.time_step) + " time_step";
      return false;
    }
    substep_ = dt * analysis_.cutting_factor;
  }
}

bool Stepper::is_interrupted() {
  if (!interrupted_ || !interrupted_()) return false;
  discard_trials();
  stop_reason_ = "interrupted";
  return true;
}

void Stepper::discard_trials() {
  substep_ = accepted_.substep;
  run_.counts = accepted_.counts;
  sleepers_.discard();
  forget_ahead();
  margin_scale_ = 1;
}

void Stepper::forget_ahead() {
  ahead_.reset();
  detected_ = false;
}

TrialSolution Stepper::find_solution(double dt) {
  if (sleepers_.wake_changing(dt)) detected_ = false;
  if (!detected_) detect(dt);
  return trial_.solve(dt);
}

bool Stepper::refuses(const TrialSolution& solution, double dt) const {
  const bool cut_enough = dt * analysis_.cutting_factor < tolerant_substep * longest_substep();
  return !solution.rejection.empty() && !(solution.friction_unsettled && cut_enough);
}

Stepper::Trial Stepper::make_trial(double dt) {
  assert(dt > 0);
  TrialSolution solution;
  if (ahead_ && ahead_->dt == dt) {
    solution = std::move(ahead_->solution);
    run_.counts = ahead_->counts;
    ahead_.reset();
  } else {
    ahead_.reset();
    solution = find_solution(dt);
  }

  const polyfem::Stopwatch watch(trial_.times().update);
  if (sleepers_.wake_hit(solution)) {
    forget_ahead();
    return Trial::woke_blocks;
  }
  rejection_ = solution.rejection;
  if (refuses(solution, dt)) return Trial::rejected;

  bool outran = false;
  for (int b = 0; b < blocks_now().n_blocks(); ++b) {
    if (!blocks_now().is_movable(b)) continue;
    const double furthest = blocks_now().block(b).furthest_vertex(solution.d);
    if (furthest > limits_.largest_displacement()) {
      rejection_ = "block " + quoted(blocks_now().names[b]) +
                   " moves further in one step than max_displacement_ratio allows";
      return Trial::rejected;
    }
    if (furthest > search_margin_[b]) {
      rejection_ =
          "block " + quoted(blocks_now().names[b]) + " moves further in one step than its search margin";
      if (search_margin_[b] >= limits_.largest_search_margin(blocks_now().block(b))) return Trial::rejected;
      outran = true;
    }
  }
  if (outran) return Trial::outran_detection;

  TrialEnd end = trial_.advance(dt, solution);
  rejection_ = end.rejection;
  if (!rejection_.empty()) return Trial::rejected;
  const auto gives_way = [&](const Pair& pair) {
    return std::ranges::any_of(of_pair(pair, trial_.contacts()), [&](const Contact& of) {
      return properties_.is_compliant(of) ||
             (of.closed() && (!properties_.has_multipliers() || of.motion.rounding));
    });
  };
  if (const std::optional<Pair> overlap = find_driven_overlap(blocks_now(), end.state, gives_way)) {
    rejection_ = "supports drive blocks " + quoted(blocks_now().names[(*overlap)[0]]) + " and " +
                 quoted(blocks_now().names[(*overlap)[1]]) + " into each other";
    return Trial::rejected;
  }
  // Which corner meets which edge is chosen before the motion is known: where that was wrong it shows here.
  if (analysis_.preset != Preset::paper && trial_.take_missed(end.state)) return Trial::missed_contacts;
  if (solution.friction_unsettled) {
    ++run_.counts.unconverged;
    run_.last_unsettled = solution.rejection + ", at time " + std::to_string(end.state.time) + " s";
  }
  accept(dt, solution, std::move(end));
  return Trial::accepted;
}

void Stepper::detect(double dt) {
  const polyfem::Stopwatch watch(trial_.times().detection);
  search_margin_ = sleepers_.look_around(dt, margin_scale_);
  // What holds blocks at rest may be their corners alone: asked when rest begins, and before a stage ends in
  // it, with as many steps left as count as rest, which comes again in three to six.
  const Equilibrium& last = run_.equilibrium;
  const int left = analysis_.steps - progress_.steps,
            enough = std::min(Sleeping::enough, (analysis_.steps + 1) / 2);
  const bool doubts = last.in_balance() && (last.unbalanced_before > largest_unbalanced || left == enough);
  if (begun_)
    trial_.detect(dt, search_margin_, doubts);
  else
    trial_.detect_first(dt, search_margin_);
  detected_ = true;
}

std::vector<Contact> Stepper::contacts_to_begin_with() {
  const SleepingBlocks::WhileStepping while_looking(sleepers_);
  forget_ahead();
  detect(analysis_.time_step);
  detected_ = false;
  return trial_.contacts();
}

}  // namespace ddacontact
