#include <ddacontact/solver/coupled_solution.hpp>

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <random>

using namespace ddacontact;

namespace {

/// A symmetric matrix and friction that follows gaps, of half the stiffness.
struct CoupledEquations {
  MatrixXd A, coupled;
  std::vector<AffineForm> rows, columns;
  std::vector<Coupling> couplings;
  VectorXd b;

  CoupledEquations(int n, int n_couplings) : rows(n_couplings), columns(n_couplings) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const MatrixXd a = MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); });
    A = coupled = a * a.transpose() + MatrixXd::Identity(n, n);
    b = VectorXd::NullaryExpr(n, [&] { return uniform(random); });
    for (int c = 0; c < n_couplings; ++c) {
      VectorXd row = VectorXd::Zero(n), column = row;
      for (int u = c; u < n; u += 3) {
        rows[c].add(u, row[u] = uniform(random));
        columns[c].add(u, column[u] = uniform(random));
      }
      couplings.push_back({&rows[c], &columns[c], 0.5});
      coupled += 0.5 * row * column.transpose();
    }
  }
  LinearSolution solution(double error = 0) const {
    return [this, error](const VectorXd& in, VectorXd& out) { out = (1 + error) * A.llt().solve(in); };
  }
};

}  // namespace

TEST(CoupledSolution, IsThatOfTheUnsymmetricMatrix) {
  const CoupledEquations equations(20, 7);
  VectorXd x;
  ASSERT_TRUE(
      solve_coupled(equations.solution(), equations.solution(), equations.couplings, equations.b, 1e-12, x));
  EXPECT_LT((equations.coupled * x - equations.b).norm(), 1e-10 * equations.b.norm());
}

TEST(CoupledSolution, WithoutCouplingsIsThatOfTheSymmetricOne) {
  const CoupledEquations equations(20, 0);
  VectorXd x;
  ASSERT_TRUE(solve_coupled(equations.solution(), equations.solution(1), {}, equations.b, 1e-12, x));
  EXPECT_LT((equations.A * x - equations.b).norm(), 1e-12 * equations.b.norm());
}

TEST(CoupledSolution, BearsRoughSolutionsWithinItsTolerance) {
  const CoupledEquations equations(20, 7);
  VectorXd x;
  ASSERT_TRUE(solve_coupled(equations.solution(), equations.solution(1e-6), equations.couplings, equations.b,
                            1e-2, x));
  EXPECT_LT((equations.coupled * x - equations.b).norm(), 5e-2 * equations.b.norm());
}

TEST(CoupledSolution, SaysThatRoughSolutionsWereTooRough) {
  const CoupledEquations equations(20, 7);
  VectorXd x;
  EXPECT_FALSE(solve_coupled(equations.solution(), equations.solution(0.5), equations.couplings, equations.b,
                             1e-4, x));
}
