/// \file Solutions with friction that follows the normal forces: what makes the matrix unsymmetric.
#pragma once

#include <ddacontact/solver/friction_problem.hpp>

namespace ddacontact {

/// x with (A + sum of row * rate * column^T) x = b, A being what `problem` last factorized. GMRES on the
/// values of column^T x, with a solution of A an iteration and no more iterations than couplings; returns the
/// solutions of A it took.
int solve_coupled(FrictionProblem& problem, const std::vector<Coupling>& couplings, const VectorXd& b,
                  VectorXd& x);

}  // namespace ddacontact
