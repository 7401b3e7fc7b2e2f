/// \file Time-scheme coefficients and initial motion of a step.
#pragma once

#include <ddacontact/core/directions.hpp>
#include <ddacontact/core/options.hpp>
#include <ddacontact/core/time_function.hpp>
#include <ddacontact/core/types.hpp>

#include <algorithm>
#include <new>

namespace ddacontact {

/// Coefficients of the time scheme.
struct StepRule {
  Scheme scheme = standard_defaults.scheme;
  double beta = 0.5, gamma = 1;  ///< of the Newmark family; midpoint has an inertia of (1/2, 1)
  RayleighDamping damping;
  /// With half steps: the time h in which impulses act, from the middle of the step before to that of
  /// this one, over dt.
  double impulse_time = 1;
  bool starts_at_rest = false;  ///< a static step

  /// Velocities that go on are those in the middle of the steps (leapfrog); forces act at the start of a
  /// step.
  bool has_half_steps() const { return scheme == Scheme::decaying || is_explicit(); }
  /// Elastic forces are those of the start of the step.
  bool is_explicit() const { return scheme == Scheme::central_difference; }
  /// Elastic forces come from both ends of the step and act at its middle, as contact forces do.
  bool mean_forces() const { return scheme == Scheme::midpoint; }
  Directions directions() const {
    return has_half_steps() ? Directions::of_start : mean_forces() ? Directions::mean : Directions::of_end;
  }
  /// Inertia forces are M (inertia() (d - dt v0) / dt^2 - history() a0).
  double inertia() const {
    if (has_half_steps()) return 1 / impulse_time;
    return scheme == Scheme::backward_euler ? 1 : 1 / beta;
  }
  double history() const { return scheme == Scheme::newmark ? 1 / (2 * beta) - 1 : 0; }
  /// Span of a step from `time` on, s, over which loads are averaged: the time in which their impulses act. A
  /// static step ends in equilibrium with the loads of its end.
  TimeSpan load_span(double time, double dt) const {
    if (has_half_steps() && !starts_at_rest) return {time + (0.5 - impulse_time) * dt, time + dt / 2};
    return {time + (mean_forces() ? 0 : dt), time + dt};
  }

  /// Whether loads on faces act on the shape that the motion at the start predicts for that time: in schemes
  /// without numerical damping, where loads on the start's shape would drive the blocks that they hold.
  bool predicts_shape() const { return !starts_at_rest && (mean_forces() || scheme == Scheme::newmark); }

  bool operator==(const StepRule&) const = default;
};

/// The scheme of the options with its coefficients. Static steps begin at rest and end in equilibrium:
/// impulses of the decaying scheme, which makes those of the explicit one too, act over their whole length,
/// and the scheme whose forces act at the middle makes them by backward Euler.
/// \param[in] dt           of the step, s
/// \param[in] previous_dt  of the step before, s; 0: there is none to go on from
inline StepRule step_rule(const AnalysisOptions& analysis, double dt, double previous_dt) {
  StepRule rule{.scheme = analysis.scheme, .damping = analysis.damping};
  rule.starts_at_rest = analysis.mode == Mode::statics;
  if (rule.starts_at_rest && rule.mean_forces()) rule.scheme = Scheme::backward_euler;
  if (rule.starts_at_rest && rule.is_explicit()) rule.scheme = Scheme::decaying;
  if (rule.scheme == Scheme::newmark) {
    rule.beta = analysis.beta;
    rule.gamma = analysis.gamma;
  }
  if (rule.has_half_steps() && !rule.starts_at_rest) rule.impulse_time = (dt + previous_dt) / (2 * dt);
  return rule;
}

/// Motion at the start of a step, of all unknowns.
struct StepStart {
  StepRule rule;
  double dt = 0;
  /// Velocity at the start; with half steps that in the middle of the step before.
  VectorXd velocity;
  VectorXd acceleration;  ///< at the start, of Newmark's schemes
};

/// Forces by which a block resists the displacements of a step, of its own unknowns, N per m. Their storage
/// serves blocks of all sizes, one after another.
class BlockForces {
 public:
  void resize(Index n_unknowns) {
    n_ = n_unknowns;
    if (storage_.rows() < n_) storage_.resize(n_, n_parts);
  }
  auto elastic() { return storage_.col(of_elasticity).head(n_); }
  auto inertia() { return storage_.col(of_inertia).head(n_); }
  auto damping() { return storage_.col(of_damping).head(n_); }

 private:
  enum Part { of_elasticity, of_inertia, of_damping, n_parts };

  MatrixXd storage_;
  Index n_ = 0;
};

}  // namespace ddacontact
