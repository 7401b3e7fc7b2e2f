/// \file Augmented Lagrangian method for a contact problem: Newton's method with a line search in each of its
/// subproblems.
#pragma once

#include <ddacontact/solver/contact_matrix.hpp>
#include <ddacontact/solver/contact_solution.hpp>

namespace ddacontact {

/// From impulses p_0 on, finds the z at which
///     A (z - z_free) = H' P(p_0 - D (H z + b + c p_0)),    D = 1 / (c + response / kappa),
/// P the projection of Coulomb's law, and takes these impulses for p_0, again and again. What each contact
/// bears is then unique also where contacts are over-determined, and the length of each of Newton's steps is
/// the one at which the step no longer gains work: without friction that is a convex minimum.
/// Afterwards problem.impulses are the best found.
/// \return their residual
ContactResidual augmented_lagrangian(ContactProblem& problem, ContactMatrix& matrix, double required,
                                     int max_factorizations, ContactSolverCounts& counts);

}  // namespace ddacontact
