#include <ddacontact/solver/coupled_solution.hpp>

#include <Eigen/QR>

#include <algorithm>

namespace ddacontact {

namespace {

constexpr double tolerance = 1e-10;
constexpr Index most_iterations = 60;

/// column^T x of every coupling.
VectorXd along_columns(const std::vector<Coupling>& couplings, const VectorXd& x) {
  VectorXd z(static_cast<Index>(couplings.size()));
  for (std::size_t c = 0; c < couplings.size(); ++c)
    z[static_cast<Index>(c)] = couplings[c].column->change(x);
  return z;
}

/// A^-1 (sum of row * rate * z).
VectorXd moved_by(FrictionProblem& problem, const std::vector<Coupling>& couplings, const VectorXd& z,
                  Index n_unknowns) {
  VectorXd force = VectorXd::Zero(n_unknowns), x;
  for (std::size_t c = 0; c < couplings.size(); ++c)
    couplings[c].row->add_gradient(couplings[c].rate * z[static_cast<Index>(c)], force);
  problem.solve(force, x);
  return x;
}

}  // namespace

int solve_coupled(FrictionProblem& problem, const std::vector<Coupling>& couplings, const VectorXd& b,
                  VectorXd& x) {
  problem.solve(b, x);
  if (couplings.empty()) return 1;
  const VectorXd rhs = along_columns(couplings, x);
  const Index n = rhs.size(), most = std::min(n, most_iterations);
  // Columns of V: an orthogonal basis of the Krylov space; of X: what A^-1 makes of them; of W: z + column^T
  // x.
  MatrixXd V(n, most), W(n, most), X(b.size(), most);
  VectorXd v = rhs, y;
  Index k = 0;
  while (k < most && v.norm() > 0) {
    V.col(k) = v.normalized();
    X.col(k) = moved_by(problem, couplings, V.col(k), b.size());
    W.col(k) = V.col(k) + along_columns(couplings, X.col(k));
    ++k;
    y = W.leftCols(k).colPivHouseholderQr().solve(rhs);
    if ((rhs - W.leftCols(k) * y).norm() <= tolerance * rhs.norm()) break;
    v = W.col(k - 1);
    for (int twice = 0; twice < 2; ++twice) v -= V.leftCols(k) * (V.leftCols(k).transpose() * v);
  }
  if (k > 0) x -= X.leftCols(k) * y;
  return 1 + static_cast<int>(k);
}

}  // namespace ddacontact
