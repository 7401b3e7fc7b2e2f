/// \file The start of a step from a state.
#pragma once

#include <ddacontact/block/state.hpp>
#include <ddacontact/block/step_start.hpp>

namespace ddacontact {

/// \param[in] previous_dt  of the step before, s; see step_rule
inline StepStart step_from(const AnalysisOptions& analysis, const BlockState& from, double dt,
                           double previous_dt) {
  const bool is_static = analysis.mode == Mode::statics;
  return {.rule = step_rule(analysis, dt, previous_dt),
          .dt = dt,
          .velocity = is_static ? VectorXd::Zero(from.velocity.size()) : from.going_on(),
          .acceleration = from.carried};
}

}  // namespace ddacontact
