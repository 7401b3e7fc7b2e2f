#include <ddacontact/solver/tangent_solver.hpp>
#include <tests/ddacontact/solver/assembled_tangent.hpp>

#include <gtest/gtest.h>

using namespace support;

TEST(MultiplyTangent, MultipliesWithTheMatrixOnTheFreeUnknowns) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    RandomBlocks blocks(seed, 2 + static_cast<int>(seed), static_cast<int>(3 * seed));
    FrictionProblem problem = blocks.problem();
    const SparseMatrix K = assembled_tangent(blocks, blocks.n_unknowns(),
                                             [&](int u) { return blocks.is_prescribed(u) ? -1 : u; });
    const VectorXd x = problem.free_part(blocks.vector(blocks.n_unknowns())), expected = K * x;
    VectorXd y;
    multiply_tangent(problem, blocks.contacts, blocks.active, blocks.couplings, x, y);
    EXPECT_LE((y - expected).norm(), 1e-14 * expected.norm()) << seed;
    for (int u = 0; u < blocks.n_unknowns(); ++u) EXPECT_TRUE(y[u] == 0 || !blocks.is_prescribed(u));
  }
}

/// The factor is of the same matrix where nothing is unsymmetric.
TEST(MultiplyTangent, IsUndoneByTheFactorOfTheSameSprings) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    RandomBlocks blocks(seed, 15, 30);
    FrictionProblem problem = blocks.problem();
    const VectorXd x = problem.free_part(blocks.vector(blocks.n_unknowns()));
    VectorXd y, back;
    multiply_tangent(problem, blocks.contacts, blocks.active, {}, x, y);
    ASSERT_TRUE(problem.factorize(blocks.contacts, blocks.active));
    problem.solve(y, back);
    EXPECT_LE((back - x).norm(), 1e-13 * x.norm()) << seed;
  }
}
