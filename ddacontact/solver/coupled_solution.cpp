#include <ddacontact/solver/coupled_solution.hpp>

#include <ddacontact/solver/krylov.hpp>

#include <cassert>
#include <cmath>

namespace ddacontact {

namespace {

constexpr int most_iterations = 60;
/// Of the values in the end, of the tolerance.
constexpr double largest_error = 2;

/// Couplings count by the root of their rate: else the gaps of contacts that bear nothing hide the others.
double weight(const Coupling& coupling) {
  return std::sqrt(std::abs(coupling.rate));
}

/// column^T x of every coupling times its weight.
VectorXd along_columns(const std::vector<Coupling>& couplings, const VectorXd& x) {
  VectorXd z(static_cast<Index>(couplings.size()));
  for (std::size_t c = 0; c < couplings.size(); ++c)
    z[c] = weight(couplings[c]) * couplings[c].column->change(x);
  return z;
}

/// sum of row * rate * z, z times the weights.
void sum_of_rows(const std::vector<Coupling>& couplings, const VectorXd& z, VectorXd& force) {
  force.setZero();
  for (std::size_t c = 0; c < couplings.size(); ++c)
    couplings[c].row->add_gradient(std::copysign(weight(couplings[c]), couplings[c].rate) * z[c], force);
}

}  // namespace

bool solve_coupled(const LinearSolution& solve, const LinearSolution& rough,
                   const std::vector<Coupling>& couplings, const VectorXd& b, double tolerance, VectorXd& x) {
  assert(tolerance > 0 && tolerance < 1);
  solve(b, x);
  if (couplings.empty()) return true;
  VectorXd z, force(b.size()), moved;
  const auto apply = [&](const VectorXd& in, VectorXd& out) {
    sum_of_rows(couplings, in, force);
    rough(force, moved);
    out = in + along_columns(couplings, moved);
  };
  const VectorXd uncoupled = along_columns(couplings, x);
  const bool converged = gmres(apply, uncoupled, tolerance, most_iterations, z).converged;
  sum_of_rows(couplings, z, force);
  solve(force, moved);
  x -= moved;
  return converged &&
         (z - along_columns(couplings, x)).norm() <= largest_error * tolerance * uncoupled.norm();
}

}  // namespace ddacontact
