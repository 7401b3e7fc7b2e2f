/// \file A step whose contact forces are found by sweeps, in rounds on one linearized geometry each.
#pragma once

#include <ddacontact/solver/augmented_contacts.hpp>

namespace ddacontact {

/// Sweeps over the contacts, from the forces of the step before, until forces and geometry have converged.
/// \param[in,out] contacts  begun, with their terms at d; then with forces and states
/// \param[in,out] d         the initial iterate, then the solution
/// \param[in,out] report    sweeps, augmentations, tolerance and residual
/// \return false: the active-set iteration has to solve the step, in quiet steps from the d before
bool solve_by_sweeps(StepProblem& system, const ContactSolverOptions& options, AugmentedContacts& contacts,
                     VectorXd& d, ContactSolverReport& report);

}  // namespace ddacontact
