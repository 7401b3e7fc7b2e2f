/// \file The contact problem of a step: augmented Lagrangian multipliers, solved by an active-set iteration,
/// an interior-point method or sweeps. A step is solved to its residual, or reported as not solved.
#pragma once

#include <ddacontact/core/directions.hpp>
#include <ddacontact/core/skips.hpp>
#include <ddacontact/solver/step_problem.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace ddacontact {

/// Tolerances and limits of the contact solver.
struct ContactSolverOptions {
  ContactSolverOptions() = default;
  /// \param[in] tolerance  of the residual; none: the defaults
  ContactSolverOptions(const std::optional<double>& tolerance, double of_penetration)
      : penetration_tolerance(of_penetration) {
    solve_to(tolerance);
  }
  /// Sets the tolerances. A coarse one is that of sweeps alone: failure is told from rest or slow change by a
  /// finer one.
  void solve_to(const std::optional<double>& tolerance) {
    const ContactSolverOptions defaults;
    sweep_tolerance = tolerance.value_or(defaults.sweep_tolerance);
    residual_tolerance = std::min(sweep_tolerance, defaults.residual_tolerance);
    coarse = sweep_tolerance > residual_tolerance;
  }

  double residual_tolerance = 1e-8;  ///< accepted residual, as a fraction of the forces on its block
  double residual_aim = 1e-12;       ///< residual below which iteration ends at once, as the same fraction
  double sweep_tolerance = residual_tolerance;  ///< residual that sweeps end at, as the same fraction
  double penetration_tolerance = 0;             ///< largest penetration over the block size; 0: plain penalty
  Directions directions = Directions::of_end;   ///< of contact forces
  /// Steps without time between them: bonds that exceed their strength break within, not at the end, and gaps
  /// of closed contacts are corrected whole.
  bool is_static = false;
  bool local = false;   ///< inertia-dominated step: waves cross only a few blocks within it
  bool coarse = false;  ///< sweeps solve steps with many active-set changes, to ten times the penetration
  bool warm_start =
      false;  ///< start from d and the contact forces, which solve a problem that differs little
  /// Contact forces act along directions that the step does not change.
  bool keeps_gradients() const { return directions == Directions::of_start; }
  int max_solutions = 600;
  bool interior_point = true;  ///< false: the active-set iteration alone
  int max_augmentations = 100;
  Skips skip = {};
};

/// How the contact solver ended, with what it took.
struct ContactSolverReport {
  SolutionStatus status = SolutionStatus::forces_unsettled;
  int iterations = 0;  ///< solutions of (13)
  int augmentations = 0;
  int sweeps = 0;                 ///< over the contacts
  int sweep_fallbacks = 0;        ///< sweeps that did not converge: the active set solved the step
  int interior_point_solves = 0;  ///< runs of the interior-point method
  int interior_solutions = 0;     ///< of `iterations`, those of the interior-point method
  double tolerance = 0;           ///< to which contact forces were solved
  Residual residual;
  int worst_contact = -1;  ///< nearest to the trouble, -1: none
};

/// Solves the step for displacements `d` (in: the initial iterate) and the contacts' states.
///
/// The law of a contact: N = max(0, lambda - p g), T = tau - p_t s clipped to what friction bears under N,
/// with g and s of the true geometry at the end of the step; forces act along the derivatives of g and s
/// there, at the start, or along their discrete gradients. lambda and tau start from the forces of the
/// step before and are replaced by N and T until g = 0 and, sticking, s = 0 within the tolerance (augmented
/// Lagrangian): the result does not depend on p and p_t then. A bond shifts the law by its strength: N >=
/// -tension, and what shear bears is more by the cohesion. One that gives way when all has settled is broken
/// for good: at the end of the step, so that it never bore more than its strength; or within, and the step is
/// solved again, where there is no time between one bond and the next (static steps).
///
/// Inertia-dominated steps are solved by sweeps over the contacts (ContactSweeps). Where the tolerance is
/// coarse, all dynamic steps begin with two sweeps; if these change the states of many contacts, sweeps
/// solve the step. In all other steps, and where sweeps do not converge, an active-set iteration finds the
/// states. If it cycles, the interior-point method finds them (find_interior_point_states), and the
/// active-set iteration finishes from there.
ContactSolverReport solve_contacts(StepProblem& system, const ContactSolverOptions& options,
                                   std::vector<Contact>& contacts, VectorXd& d);

}  // namespace ddacontact
