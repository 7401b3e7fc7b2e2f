/// \file Open-close iteration: contact states that agree with the displacements they lead to.
#pragma once

#include <ddacontact/equations/step_system.hpp>
#include <ddacontact/solver/contact_solver.hpp>

#include <vector>

namespace ddacontact {

/// Starting from the contacts' states and d = the prescribed displacements, solves (13) and adapts the states
/// until they agree with the solution ("surmised and calculated contact state are consistent", end of section
/// 4), and the residual, with friction taken from the present penetration, is below tolerance.
///
/// For given states the size of friction (49) depends on the penetration, which (13) leaves out of K: the
/// iteration d -= K^-1 r(d) repairs that, accelerated, before the states are looked at. Leaves the states in
/// `contacts` and sets their `was_closed`.
ContactSolverReport iterate_open_close(StepSystem& system, std::vector<Contact>& contacts, VectorXd& d);

}  // namespace ddacontact
