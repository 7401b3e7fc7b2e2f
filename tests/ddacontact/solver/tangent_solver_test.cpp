#include <ddacontact/solver/tangent_solver.hpp>
#include <tests/ddacontact/solver/assembled_tangent.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// The largest entry of b - K x on the free unknowns, over that of b.
double part_left(const RandomBlocks& blocks, const VectorXd& b, const VectorXd& x) {
  const SparseMatrix K =
      assembled_tangent(blocks, blocks.n_unknowns(), [&](int u) { return blocks.is_prescribed(u) ? -1 : u; });
  VectorXd left = b - K * x;
  for (int u = 0; u < blocks.n_unknowns(); ++u)
    if (blocks.is_prescribed(u)) left[u] = 0;
  return left.norm() / b.norm();
}

Skips stale(bool factor) {
  Skips skip;
  skip.stale_factor = factor;
  return skip;
}

}  // namespace

TEST(TangentSolver, SolvesWithFrictionThatFollowsNormalForces) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomBlocks blocks(seed, 12, 25);
    FrictionProblem problem = blocks.problem();
    TangentSolver solver(problem, {});
    const VectorXd b = blocks.vector(blocks.n_unknowns());
    VectorXd x;
    ASSERT_TRUE(solver.solve(blocks.contacts, blocks.active, blocks.couplings, b, x));
    EXPECT_LE(part_left(blocks, b, x), 1e-12) << seed;
    for (int u = 0; u < blocks.n_unknowns(); ++u) EXPECT_TRUE(x[u] == 0 || !blocks.is_prescribed(u));
    EXPECT_EQ(solver.counts().with_stale_factor, 0);
  }
}

/// A spring in a hundred changes: the factor serves on; three in a hundred: a new one is made.
TEST(TangentSolver, AFactorServesOnWhileFewSpringsChange) {
  for (const bool skips : {true, false})
    for (const int changed : {1, 3}) {
      RandomBlocks blocks(5, 40, 100);
      FrictionProblem problem = blocks.problem();
      TangentSolver solver(problem, stale(skips));
      const VectorXd b = blocks.vector(blocks.n_unknowns());
      VectorXd x;
      ASSERT_TRUE(solver.solve(blocks.contacts, blocks.active, {}, b, x));
      for (int c = 0; c < changed; ++c) blocks.active[static_cast<std::size_t>(10 * c)] ^= 1;
      blocks.couplings.clear();
      ASSERT_TRUE(solver.solve(blocks.contacts, blocks.active, {}, b, x));
      EXPECT_LE(part_left(blocks, b, x), 1e-3);
      EXPECT_EQ(solver.counts().with_stale_factor, skips && changed == 1);
      EXPECT_EQ(solver.counts().iterations > 0, skips && changed == 1);
      EXPECT_EQ(problem.cholesky().n_factorizations(), skips && changed == 1 ? 1 : 2);
    }
}

/// Friction of many contacts grows: the iteration does not converge, a factor is made, and no other one is
/// tried.
TEST(TangentSolver, AFactorThatFailedIsNotTriedAgain) {
  RandomBlocks blocks(5, 40, 200);
  FrictionProblem problem = blocks.problem();
  TangentSolver solver(problem, {});
  const VectorXd b = blocks.vector(blocks.n_unknowns());
  VectorXd x;
  for (int round = 0; round < 3; ++round) {
    for (Coupling& coupling : blocks.couplings) coupling.rate *= 10;
    ASSERT_TRUE(solver.solve(blocks.contacts, blocks.active, blocks.couplings, b, x));
    EXPECT_LE(part_left(blocks, b, x), 1e-3);
    EXPECT_EQ(solver.counts().fallbacks, round > 0);
  }
  EXPECT_EQ(solver.counts().with_stale_factor, 0);
}

TEST(TangentSolver, SaysWhenTheMatrixIsNotDefinite) {
  RandomBlocks blocks(6, 4, 0);
  FrictionProblem problem = blocks.problem();
  for (MatrixXd& element : problem.elements()) element *= -1;
  TangentSolver solver(problem, {});
  VectorXd x;
  EXPECT_FALSE(solver.solve({}, {}, {}, blocks.vector(blocks.n_unknowns()), x));
}

TEST(TangentSolver, CountsAddUp) {
  TangentCounts sum{1, 2, 3};
  sum += {10, 20, 30};
  EXPECT_EQ(sum.with_stale_factor, 11);
  EXPECT_EQ(sum.iterations, 22);
  EXPECT_EQ(sum.fallbacks, 33);
}
