/// \file Semismooth Newton method for a contact problem: active sets with an augmented Lagrangian.
#pragma once

#include <ddacontact/solver/contact_matrix.hpp>
#include <ddacontact/solver/contact_solution.hpp>

namespace ddacontact {

/// Solves from problem.impulses on by guessing the state of every contact and solving the linear system of
/// that guess. A closed contact's impulse is found from
///     p_new = p - rho (u + c p_new),    rho = kappa / response,
/// which is exact in the limit of repetition, with the same factors, and has one solution where contacts are
/// over-determined: the one nearest to p. Slip turns round only through stick. It may go round in circles.
/// Afterwards the impulses are the best found.
/// \param[in] required  the residual at which it ends with states that still change
/// \param[in] target    that it is iterated to while states stay
/// \return the residual of these
ContactResidual newton(ContactProblem& problem, ContactMatrix& matrix, double required, double target,
                       int max_factorizations, ContactSolverCounts& counts);

}  // namespace ddacontact
