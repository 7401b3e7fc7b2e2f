/// \file The interior-point method for the contacts of a step with many active-set changes.
#pragma once

#include <ddacontact/solver/step_problem.hpp>
#include <ddacontact/solver/swept_law.hpp>

#include <functional>
#include <vector>

namespace ddacontact {

/// How find_interior_point_states ended.
struct InteriorReport {
  bool found = false;  ///< false: forces are not finite, or the matrix is singular
  int solutions = 0;   ///< each with a factor of its own
};

/// The contacts of a step with their laws and terms, which follow the displacements.
struct EvaluatedContacts {
  const std::vector<Contact>& contacts;
  const std::vector<SweptLaw>& laws;
  std::vector<ContactTerm>& terms;
  std::function<void()> evaluate;  ///< makes the terms anew at d, geometry included
};

/// Finds the states of the contacts of a step where the active-set iteration cycles: a primal-dual
/// interior-point method (Mehrotra 1992). Each contact keeps, with a = lambda - p g and q = tau - p_t s,
///   N, y > 0:           N - y = a,                                        N y = mu,
///   u, v, f, k > 0:     u = b(N) - T,  v = b(N) + T,  T + f - k = q,      u f = v k = mu,
/// (of a bond N and a with its tension added) whose limit mu -> 0 is its law, and mu falls with every
/// solution of Newton's method for these and balance. It takes some twenty solutions whatever the number of
/// contacts. Where it does not converge, as with much friction, the central path is followed from large mu on
/// by arc length (Keller 1977), in some hundred solutions or more: it has folds where the problem has several
/// solutions, and mu rises for a while.
///
/// \param[in,out] d   where to start; then the last displacements. Blocks move as by StepProblem::move
/// \param[out] states of the springs, see spring_state.hpp
InteriorReport find_interior_point_states(StepProblem& system, const EvaluatedContacts& contacts, VectorXd& d,
                                          std::vector<unsigned char>& states);

}  // namespace ddacontact
