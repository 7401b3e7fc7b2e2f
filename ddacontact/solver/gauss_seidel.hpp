/// \file Projected Gauss-Seidel: every contact in turn is solved exactly with the others' impulses as they
/// are.
#pragma once

#include <ddacontact/solver/contact_problem.hpp>

namespace ddacontact {

/// One sweep over all contacts, forward or backward: problem.impulses are changed, and z with them.
/// \param[in,out] z  the problem's velocity()
void sweep(ContactProblem& problem, VectorXd& z, bool forward);

/// The impulses that obey the law of a contact alone. \param[in] start  its impulses so far
/// \param[in] rates  u and v with these
NormalAndShear solve_contact(const CoulombLaw& law, const NormalAndShear& response, double cross_response,
                             const NormalAndShear& start, const NormalAndShear& rates);

}  // namespace ddacontact
