#include <ddacontact/solver/krylov.hpp>
#include <ddacontact/solver/tangent_sweeps.hpp>
#include <tests/ddacontact/solver/assembled_tangent.hpp>

#include <gtest/gtest.h>

#include <Eigen/LU>

using namespace support;

namespace {

struct Swept {
  RandomBlocks blocks;
  FrictionProblem problem;
  BlockGroups groups;
  TangentSweeps sweeps;
  Eigen::VectorXf b, x, y;

  Swept(unsigned seed, int n_blocks, int n_contacts)
      : blocks(seed, n_blocks, n_contacts), problem(blocks.problem()) {
    EXPECT_TRUE(groups.set(problem, blocks.contacts));
    EXPECT_TRUE(sweeps.set(problem, groups, blocks.contacts, blocks.active, blocks.couplings));
    VectorXd packed;
    groups.pack(blocks.vector(blocks.n_unknowns()), packed);
    b = packed.cast<float>();
  }

  /// Over packed vectors; the identity at held unknowns.
  SparseMatrix matrix() const {
    SparseMatrix K = assembled_tangent(blocks, groups.n_unknowns(), [&](int u) { return groups.place(u); });
    VectorXd held = VectorXd::Ones(groups.n_unknowns());
    for (int u = 0; u < blocks.n_unknowns(); ++u)
      if (groups.place(u) >= 0) held[groups.place(u)] = 0;
    return K + SparseMatrix(held.asDiagonal());
  }

  /// M x by its factors.
  VectorXd preconditioner_times(const SparseMatrix& K, const VectorXd& in) const {
    std::vector<int> block_of;
    for (int k = 0; k < groups.n_blocks(); ++k)
      block_of.insert(block_of.end(), static_cast<std::size_t>(groups.unknowns(k).count), k);
    const auto part = [&](int order) {
      SparseMatrix of_order = K;
      of_order.prune([&](Index row, Index column, double) {
        const int r = block_of[static_cast<std::size_t>(row)], c = block_of[static_cast<std::size_t>(column)];
        return BlockGroups::group_of(r) == BlockGroups::group_of(c) && (c > r) - (c < r) == order;
      });
      return of_order;
    };
    const SparseMatrix D = part(0);
    const VectorXd upper = D * in + part(1) * in;
    VectorXd solved(upper.size());
    for (int k = 0; k < groups.n_blocks(); ++k) {
      const auto [first, n] = groups.unknowns(k);
      solved.segment(first, n) = MatrixXd(D.block(first, first, n, n)).lu().solve(upper.segment(first, n));
    }
    return upper + part(-1) * solved;
  }
};

}  // namespace

/// Among few blocks, and where groups meet.
TEST(TangentSweeps, ApplyThePreconditionerAndTheMatrixToSinglePrecision) {
  for (unsigned seed = 0; seed <= 30; ++seed) {
    const bool large = seed == 30;
    Swept s(seed, large ? BlockGroups::group_size + 700 : 2 + static_cast<int>(seed),
            large ? 26000 : static_cast<int>(3 * seed));
    EXPECT_EQ(s.groups.n_groups(), large ? 2 : 1);
    s.sweeps.apply(s.b, s.x, s.y);
    const SparseMatrix K = s.matrix();
    const VectorXd x = s.x.cast<double>(), b = s.b.cast<double>(), Kx = K * x;
    EXPECT_LE((s.y.cast<double>() - Kx).norm(), 1e-5 * Kx.norm()) << seed;
    EXPECT_LE((s.preconditioner_times(K, x) - b).norm(), 1e-5 * b.norm()) << seed;
  }
}

TEST(TangentSweeps, HelpIterationsToConverge) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Swept s(seed, 40, 100);
    Eigen::VectorXf x;
    const KrylovReport report = bicgstab([&](const Eigen::VectorXf& b, Eigen::VectorXf& moved,
                                             Eigen::VectorXf& product) { s.sweeps.apply(b, moved, product); },
                                         s.b, 1e-4, 60, x);
    EXPECT_TRUE(report.converged);
    const VectorXd b = s.b.cast<double>();
    EXPECT_LE((b - s.matrix() * x.cast<double>()).norm(), 2e-4 * b.norm());
  }
}

TEST(TangentSweeps, GiveTheSameBytesForAnyNumberOfThreads) {
  Swept s(1, 2 * BlockGroups::group_size + 900, 60000);
  ASSERT_EQ(s.groups.n_groups(), 3);
  s.sweeps.apply(s.b, s.x, s.y);
  for (int threads : {1, 2, 3}) {
    polyfem::set_threads(threads);
    TangentSweeps others;
    ASSERT_TRUE(others.set(s.problem, s.groups, s.blocks.contacts, s.blocks.active, s.blocks.couplings));
    Eigen::VectorXf x, y;
    others.apply(s.b, x, y);
    EXPECT_EQ(x, s.x);
    EXPECT_EQ(y, s.y);
  }
  polyfem::set_threads(1);
}

TEST(TangentSweeps, RefuseABlockWithoutInverse) {
  Swept s(4, 6, 0);
  for (MatrixXd& matrix : s.problem.elements()) matrix.setZero();
  EXPECT_FALSE(s.sweeps.set(s.problem, s.groups, s.blocks.contacts, s.blocks.active, s.blocks.couplings));
}
