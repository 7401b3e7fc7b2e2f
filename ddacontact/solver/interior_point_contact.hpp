/// \file Interior-point method for a contact problem: the way to the states where active sets cycle.
#pragma once

#include <ddacontact/solver/contact_matrix.hpp>
#include <ddacontact/solver/contact_solution.hpp>

namespace ddacontact {

/// Follows the central path of
///     y = u + c_n p,             y p = mu,
///     a_+ = F(p) - q,  a_- = F(p) + q,    v + c_t q + l_+ - l_- = 0,    l_+ a_+ = l_- a_- = mu,
/// to mu = 0 by Newton's method, friction in the tangent, with Mehrotra's predictor and corrector (1992).
/// Bonded contacts are equations. Starts
/// well inside the laws, near what problem.impulses predict; these become the best found.
/// \param[in] required  the residual at which it ends
/// \return the residual
ContactResidual interior_point(ContactProblem& problem, ContactMatrix& matrix, double required,
                               ContactSolverCounts& counts);

}  // namespace ddacontact
