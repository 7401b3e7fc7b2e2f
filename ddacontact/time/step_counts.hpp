/// \file Counts of a run: steps, solutions, events.
#pragma once

namespace ddacontact {

/// Totals since the start of the run, unless stated.
struct StepCounts {
  long steps = 0;               ///< whole steps of the length the scene states
  long substeps = 0;            ///< accepted trial steps
  long rejected = 0;            ///< trial steps rejected and repeated, most of them shorter
  long overlap_rejections = 0;  ///< of these, for a missed penetration
  long corner_solutions = 0;    ///< trial steps solved again because corners met other edges
  long unsettled_corners = 0;   ///< of these, accepted although the last solution met other edges again
  long unconverged = 0;         ///< accepted although stick and slip had not settled
  long contact_iterations = 0;  ///< solutions of (13), in all trial steps
  long linear_solves = 0, factorizations = 0;
  long interior_point_solves = 0;  ///< see find_interior_point_states
  long augmentations = 0;
  long sweeps = 0;               ///< over the contacts, see ContactSweeps
  long interior_solutions = 0;   ///< of contact_iterations, those of the interior-point method
  long solver_fallbacks = 0;     ///< sweeps that did not converge
  double largest_tolerance = 0;  ///< to which contacts were solved in any accepted substep
  long broken_bonds = 0;
  long impacts = 0;          ///< contacts that met with a speed that counts
  long limited_impacts = 0;  ///< impacts whose restitution was reduced so that no energy arose
  long unsettled_impacts =
      0;  ///< impacts whose friction did not agree with their normal impulses to the last
  long unknown_velocities = 0;  ///< substeps after which no solution told the velocity at their end
  long contacts_max = 0;        ///< closed at the end of a substep, at most
  long contacts = 0;            ///< closed at the end of the last one
  long asleep = 0;              ///< blocks asleep at the end of the last substep
  long equations = 0;           ///< of (13) in the last substep
  double max_penetration = 0;   ///< m, at the end of any substep
  double max_residual = 0;      ///< Residual::block_relative of any accepted substep, at most
};

}  // namespace ddacontact
