/// \file Solves a contact problem, island by island.
#pragma once

#include <ddacontact/solver/contact_problem.hpp>

namespace ddacontact {

/// When and how hard.
struct ContactSolverOptions {
  double tolerance = 1e-8;  ///< block-relative residual that a solution has to meet
  double target = 1e-12;    ///< that is iterated to while it is cheap
};

/// What a solution took.
struct ContactSolverCounts {
  long sweeps = 0;             ///< of Gauss-Seidel over all contacts of an island
  long newton_iterations = 0;  ///< linear systems solved by the active-set Newton method
  long factorizations = 0;
  long interior_point_solves = 0;  ///< islands for which the interior-point method was used
  long interior_point_iterations = 0;
};

/// How a contact problem was solved.
struct ContactSolution {
  bool solved = false;       ///< every contact meets the tolerance
  VectorXd velocity;         ///< z; of the best impulses found where not solved
  ContactResidual residual;  ///< of all
  ContactSolverCounts counts;
};

/// Finds impulses (problem.impulses: in, a warm start; out, the solution) and velocities. Bodies that
/// contacts connect are an island; each is solved by itself: by Gauss-Seidel sweeps while they
/// converge, then by a semismooth Newton method on active sets, then by an interior-point method with
/// Newton's last steps. The same bytes for the same problem.
ContactSolution solve(ContactProblem& problem, const ContactSolverOptions& options = {});

}  // namespace ddacontact
