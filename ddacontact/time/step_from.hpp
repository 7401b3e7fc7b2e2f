/// \file The start of a step from a state.
#pragma once

#include <ddacontact/block/state.hpp>
#include <ddacontact/block/step_start.hpp>

namespace ddacontact {

/// The scheme of a step from a state. Where there are no accelerations that Newmark's scheme could go on
/// from, at the start of a run and when what acts has changed, they are constant in the step.
///
/// \param[in] previous_dt  of the step before, s; see step_rule
inline StepRule rule_from(const AnalysisOptions& analysis, const BlockState& from, double dt,
                          double previous_dt) {
  StepRule rule = step_rule(analysis, dt, previous_dt);
  if (rule.scheme == Scheme::newmark && from.carried.isZero(0)) {
    rule.beta = 0.5;
    rule.gamma = 1;
  }
  return rule;
}

/// The step itself, with what goes on from the state.
inline StepStart step_from(const AnalysisOptions& analysis, const BlockState& from, double dt,
                           double previous_dt) {
  const bool is_static = analysis.mode == Mode::statics;
  return {.rule = rule_from(analysis, from, dt, previous_dt),
          .dt = dt,
          .velocity = is_static ? VectorXd::Zero(from.velocity.size()) : from.going_on(),
          .acceleration = from.carried};
}

}  // namespace ddacontact
