/// \file The staged contact method: a step solved to its residual, whatever the contacts' stiffness, or not
/// at all.
#pragma once

#include <ddacontact/solver/step_system.hpp>
#include <ddacontact/solver/tangent_solver.hpp>

#include <optional>

namespace ddacontact {

/// When the staged method ends.
struct StagedOptions {
  StagedOptions() = default;
  /// \param[in] tolerance  of the residual in all steps; none: the defaults
  StagedOptions(const std::optional<double>& tolerance, double of_penetration)
      : penetration_tolerance(of_penetration) {
    solve_to(tolerance);
  }
  void solve_to(const std::optional<double>& tolerance) {
    const StagedOptions defaults;
    residual_tolerance = tolerance.value_or(defaults.residual_tolerance);
    coarse = residual_tolerance > defaults.residual_tolerance;
    residual_aim = coarse ? residual_tolerance : defaults.residual_aim;
  }

  double residual_tolerance = 1e-8;            ///< of the forces on each block: what is accepted
  double residual_aim = 1e-12;                 ///< what is iterated to while that goes on
  double penetration_tolerance = 0;            ///< of the block size; 0: plain penalty
  Directions directions = Directions::of_end;  ///< of contact forces
  /// Steps without time between them: bonds that exceed their strength break within, not at the end, and gaps
  /// of closed contacts are taken back whole.
  bool is_static = false;
  bool local = false;   ///< what happens in the step stays within a few blocks: waves are slow for it
  bool coarse = false;  ///< violent steps are left to sweeps, and contacts may be ten times as deep there
  bool again = false;   ///< d and the contacts' forces are those of a solution nearby, to start from
  /// Contact forces act along directions that the step does not change.
  bool keeps_gradients() const { return directions == Directions::of_start; }
  int max_solutions = 600;
  bool inside = true;  ///< false: stage 0 alone
  int max_augmentations = 10;
  Skips skip = {};
};

/// Whether the step may be accepted; if not, it is cut.
enum class StagedStatus {
  settled,      ///< the residual passes, and penetration is below its tolerance
  unsettled,    ///< the residual does not pass
  penetrating,  ///< the residual passes, penetration stays above its tolerance
  not_positive_definite,
  not_finite
};

/// How the method ended, with what it took.
struct StagedReport {
  StagedStatus status = StagedStatus::unsettled;
  int iterations = 0;  ///< solutions of (13)
  int augmentations = 0;
  int sweeps = 0;              ///< over the contacts
  int interior_paths = 0;      ///< searches for the states from inside the contacts' laws
  int interior_solutions = 0;  ///< of `iterations`, those of these
  double tolerance = 0;        ///< that contact forces were solved to
  TangentCounts tangent;
  Residual residual;
  int worst_contact = -1;  ///< nearest to the trouble, -1: none
};

/// Solves the step for displacements `d` (in: where to start) and the contacts' states.
///
/// The law of a contact: N = max(0, lambda - p g), T = tau - p_t s clipped to what friction bears under N,
/// with g and s of the true geometry at the end of the step; forces act along the derivatives of g and s
/// there, at the start, or along their discrete gradients. lambda and tau start from the forces of the
/// step before and are replaced by N and T until g = 0 and, sticking, s = 0 within the tolerance: p and p_t
/// do not matter then. A bond shifts the law by its strength: N >= -tension, and what shear bears is more by
/// the cohesion. One that gives way when all has settled is broken for good: at the end of the step, so that
/// it never bore more than its strength; or within, and the step is solved again, where there is no time
/// between one bond and the next (static steps).
///
/// Local steps are solved by sweeps over the contacts (ContactSweeps). Where the tolerance is coarse all
/// dynamic steps begin with two sweeps, and go on with them where many contacts change their states in these:
/// such steps are violent. In other steps, or where sweeps do not come to rest, stage 0 follows the active
/// set, as open-close does. When that goes round in circles, stage 1 finds the states from inside the
/// contacts' laws (find_states_from_inside), and stage 0 goes on.
StagedReport solve_staged(StepSystem& system, const StagedOptions& options, std::vector<Contact>& contacts,
                          VectorXd& d);

}  // namespace ddacontact
