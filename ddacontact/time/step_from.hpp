/// \file The start of a step from a state.
#pragma once

#include <ddacontact/block/state.hpp>
#include <ddacontact/block/step_start.hpp>

namespace ddacontact {

/// The scheme of a step from a state. Where there are no accelerations that Newmark's scheme could go on
/// from, at the start of a run and when what acts has changed, they are constant in the step.
inline StepRule rule_from(const AnalysisOptions& analysis, const BlockState& from, double dt) {
  StepRule rule = step_rule(analysis, dt, from.carried_dt);
  if (rule.scheme == Scheme::newmark && from.carried.isZero(0)) {
    rule.beta = 0.5;
    rule.gamma = 1;
  }
  return rule;
}

/// The step itself, with what goes on from the state.
inline StepStart step_from(const AnalysisOptions& analysis, const BlockState& from, double dt) {
  const bool is_static = analysis.mode == Mode::statics;
  return {.rule = rule_from(analysis, from, dt),
          .dt = dt,
          .velocity = is_static ? VectorXd::Zero(from.velocity.size()) : from.going_on(),
          .acceleration = from.carried};
}

}  // namespace ddacontact
