/// \file Solutions with friction that follows the normal forces, by which the matrix is unsymmetric.
#pragma once

#include <ddacontact/solver/contact_term.hpp>

#include <functional>
#include <vector>

namespace ddacontact {

/// A term row * rate * column^T of the matrix: `row` is the slip that friction acts along, `column` the gap
/// that it follows.
struct Coupling {
  const AffineForm* row;
  const AffineForm* column;
  double rate;
  std::size_t contact = 0;  ///< the contact of this gap and slip
};

/// x = A^-1 b of a symmetric A that is factorized.
using LinearSolution = std::function<void(const VectorXd& b, VectorXd& x)>;

/// x with (A + sum of row * rate * column^T) x = b. GMRES on the values of column^T x, with a solution of A
/// an iteration, to `tolerance` of what they are without the couplings; false: not as near as that.
/// \param[in] rough  solves in the iterations: its error appears in the values alone, and is checked
bool solve_coupled(const LinearSolution& solve, const LinearSolution& rough,
                   const std::vector<Coupling>& couplings, const VectorXd& b, double tolerance, VectorXd& x);

}  // namespace ddacontact
