/// \file Energies of an accepted trial.
#pragma once

#include <ddacontact/time/energy_ledger.hpp>
#include <ddacontact/time/trial_step.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// A trial that is accepted; its system still has the step begun.
struct AcceptedTrial {
  const BlockSystem& blocks;
  const BlockState& before;
  TrialStep& trial;
  const TrialSolution& solution;

  /// Motion of all unknowns that its forces work on.
  VectorXd motion() const {
    return trial.system().rule().has_half_steps() ? solution.straight : solution.motion();
  }
};

/// Adds the work of gravity, loads, supports, contacts and damping, and what the scheme takes; of inertia's
/// work the change of kinetic energy is still to be taken off (`book_kinetic`). Gap and slip changes of the
/// contacts become those along the motion.
void account(const AcceptedTrial& accepted, Energy& energy);
/// Ends the step of the bolts: writes what `next` has of them and adds their losses. Returns the names of
/// those that tear.
std::vector<std::string> end_bolts(const AcceptedTrial& accepted, BlockState& next, Energy& energy);
/// Adds what an impact took. How much of it is friction's is told by its impulses, which need not be unique.
void account_impact(const StepImpact& impact, Energy& energy);
/// Books a kinetic energy, J per m; its change is taken off the work of inertia.
void book_kinetic(double kinetic, Energy& energy);

}  // namespace ddacontact
