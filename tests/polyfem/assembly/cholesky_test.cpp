#include <polyfem/assembly/cholesky.hpp>
#include <polyfem/core/out_of_memory.hpp>
#include <polyfem/core/parallel.hpp>
#include <tests/support/grid_laplacian.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

using namespace polyfem;
using support::grid_laplacian;

namespace {

VectorXd random_vector(Index n) {
  std::mt19937 random(static_cast<unsigned>(n));
  std::uniform_real_distribution<double> values(-1, 1);
  VectorXd v(n);
  for (double& value : v) value = values(random);
  return v;
}

double relative_residual(const SparseMatrix& lower, const VectorXd& x, const VectorXd& b) {
  return (lower.selfadjointView<Eigen::Lower>() * x - b).norm() / b.norm();
}

void analyze(const SparseMatrix& K, bool dissected, Cholesky& cholesky) {
  if (dissected)
    cholesky.dissect(K);
  else
    cholesky.analyze(K);
}

/// An unsymmetric matrix of the pattern of a grid: of the entries above the diagonal each is between -1 and 1.
struct Unsymmetric {
  SparseMatrix lower;
  VectorXd more_above;

  Unsymmetric(int side, double shift) : lower(grid_laplacian(side, shift)), more_above(lower.nonZeros()) {
    const VectorXd above = random_vector(lower.nonZeros());
    int k = 0;
    for (int c = 0; c < lower.cols(); ++c)
      for (SparseMatrix::InnerIterator entry(lower, c); entry; ++entry, ++k)
        more_above[k] = entry.row() == c ? 0 : above[k] - entry.value();
  }
  double relative_residual(const VectorXd& x, const VectorXd& b) const {
    SparseMatrix above = lower;
    Eigen::Map<VectorXd>(above.valuePtr(), above.nonZeros()) += more_above;
    const VectorXd Kx = lower * x + above.transpose() * x - lower.diagonal().cwiseProduct(x);
    return (Kx - b).norm() / b.norm();
  }
};

class CholeskyOfGrid : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Side, CholeskyOfGrid, testing::Values(1, 2, 5, 20, 150));

TEST_P(CholeskyOfGrid, Solves) {
  const SparseMatrix K = grid_laplacian(GetParam(), 0.1);
  const VectorXd b = random_vector(K.rows());
  VectorXd x;
  for (const bool dissected : {false, true}) {
    Cholesky cholesky;
    analyze(K, dissected, cholesky);
    ASSERT_TRUE(cholesky.factorize(K));
    cholesky.solve(b, x);
    EXPECT_LT(relative_residual(K, x, b), 1e-13);
  }
}

TEST_P(CholeskyOfGrid, CountsTheMemoryOfItsFactor) {
  const SparseMatrix K = grid_laplacian(GetParam(), 0.1);
  Cholesky cholesky;
  const double before = cholesky.memory();
  cholesky.analyze(K);
  ASSERT_TRUE(cholesky.factorize(K));
  EXPECT_GE(cholesky.memory() - before, sizeof(double) * cholesky.n_factor_entries());
}

TEST_P(CholeskyOfGrid, KeepsItsAnalysisForNewValues) {
  const VectorXd b = random_vector(GetParam() * GetParam());
  VectorXd x;
  Cholesky cholesky;
  cholesky.analyze(grid_laplacian(GetParam(), 0.1));
  for (const double shift : {0.1, 1., 10., 0.5}) {
    const SparseMatrix K = grid_laplacian(GetParam(), shift);
    ASSERT_TRUE(cholesky.factorize(K));
    for (int repetition = 0; repetition < 2; ++repetition) {
      cholesky.solve(b, x);
      EXPECT_LT(relative_residual(K, x, b), 1e-13);
    }
  }
  EXPECT_EQ(cholesky.n_analyses(), 1);
  EXPECT_EQ(cholesky.n_factorizations(), 4);
  EXPECT_EQ(cholesky.n_solves(), 8);
}

TEST_P(CholeskyOfGrid, SolvesUnsymmetricEquationsOfTheSamePattern) {
  const Unsymmetric K(GetParam(), 0.1);
  const VectorXd b = random_vector(K.lower.rows());
  VectorXd x, again;
  for (const bool dissected : {false, true}) {
    Cholesky cholesky;
    analyze(K.lower, dissected, cholesky);
    for (int repetition = 0; repetition < 2; ++repetition) {
      ASSERT_TRUE(cholesky.factorize(K.lower, K.more_above));
      cholesky.solve(b, x);
      EXPECT_LT(K.relative_residual(x, b), 1e-13);
      ASSERT_TRUE(cholesky.factorize(K.lower));
      cholesky.solve(b, x);
      EXPECT_LT(relative_residual(K.lower, x, b), 1e-13);
    }
    ASSERT_TRUE(cholesky.factorize(K.lower, VectorXd::Zero(K.lower.nonZeros())));
    cholesky.solve(b, again);
    EXPECT_LT((again - x).norm(), 1e-13 * x.norm()) << "as the symmetric one";
  }
}

/// Pivots below 0 serve, one that is 0 does not.
TEST(Cholesky, AnUnsymmetricFactorNeedsPivotsOtherThanZero) {
  const double shift = 0.1;
  SparseMatrix K = grid_laplacian(5, shift);
  const VectorXd none = VectorXd::Zero(K.nonZeros()), b = random_vector(K.rows());
  Cholesky cholesky;
  cholesky.analyze(K);
  const SparseMatrix negative = -K;
  ASSERT_TRUE(cholesky.factorize(negative, none));
  VectorXd x;
  cholesky.solve(b, x);
  EXPECT_LT((negative.selfadjointView<Eigen::Lower>() * x - b).norm(), 1e-13 * b.norm());
  for (int k = K.outerIndexPtr()[12]; k < K.outerIndexPtr()[13]; ++k) K.valuePtr()[k] = 0;
  for (int c = 0; c < 12; ++c)
    if (K.coeff(12, c) != 0) K.coeffRef(12, c) = 0;
  EXPECT_FALSE(cholesky.factorize(K, none));
  EXPECT_EQ(cholesky.failed_row(), 12);
  EXPECT_TRUE(cholesky.factorize(grid_laplacian(5, shift), none));
  EXPECT_EQ(cholesky.failed_row(), -1);
  EXPECT_FALSE(cholesky.factorize(K, none));
  cholesky.analyze(SparseMatrix(0, 0));
  EXPECT_EQ(cholesky.failed_row(), -1) << "of another matrix";
}

/// Its inverse is no number.
TEST(Cholesky, ADenormalPivotDoesNotServe) {
  SparseMatrix K(2, 2);
  K.insert(0, 0) = 1e-310;
  K.insert(1, 1) = 1;
  K.makeCompressed();
  Cholesky cholesky;
  cholesky.analyze(K);
  EXPECT_FALSE(cholesky.factorize(K, VectorXd::Zero(2)));
}

TEST(Cholesky, SolvesWithTheSameBytesByAnyNumberOfThreads) {
  const SparseMatrix K = grid_laplacian(300, 0.1);
  const VectorXd b = random_vector(K.rows());
  for (const bool dissected : {false, true}) {
    Cholesky cholesky;
    analyze(K, dissected, cholesky);
    ASSERT_TRUE(cholesky.factorize(K));
    ASSERT_GT(cholesky.n_factor_entries(), 1e6) << "too small to be shared";
    VectorXd alone, shared;
    cholesky.solve(b, alone);
    EXPECT_LT(relative_residual(K, alone, b), 1e-13);
    for (const int threads : {2, 3, 8}) {
      set_threads(threads);
      cholesky.solve(b, shared);
      EXPECT_EQ(shared, alone) << threads;
    }
    set_threads(1);
    ASSERT_TRUE(cholesky.factorize_roughly(K));
    cholesky.solve_roughly(b, alone);
    EXPECT_LT(relative_residual(K, alone, b), 1e-5);
    for (const int threads : {2, 3, 8}) {
      set_threads(threads);
      cholesky.solve_roughly(b, shared);
      EXPECT_EQ(shared, alone) << threads;
    }
    set_threads(1);
  }
}

TEST(Cholesky, LeavesFewerEntriesOfWhatItDissects) {
  const SparseMatrix K = grid_laplacian(400, 0.1);
  Cholesky cholesky;
  cholesky.analyze(K, minimum_degree_order({K.outerIndexPtr(), K.outerIndexPtr() + K.rows() + 1},
                                           {K.innerIndexPtr(), K.innerIndexPtr() + K.nonZeros()}));
  const double n_entries = cholesky.n_factor_entries();
  cholesky.dissect(K);
  EXPECT_LT(cholesky.n_factor_entries(), 0.95 * n_entries);
}

TEST_P(CholeskyOfGrid, ReportsAMatrixThatIsNotPositiveDefiniteAndRecovers) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const SparseMatrix good = grid_laplacian(GetParam(), 0.1);
  Cholesky cholesky;
  cholesky.analyze(good);
  EXPECT_FALSE(cholesky.factorize(grid_laplacian(GetParam(), -4.5)));  // the diagonal is negative
  EXPECT_FALSE(cholesky.factorize(grid_laplacian(GetParam(), -4)));    // the trace is zero
  EXPECT_TRUE(cholesky.factorize(good));
  const VectorXd b = random_vector(good.rows());
  VectorXd x;
  cholesky.solve(b, x);
  EXPECT_LT(relative_residual(good, x, b), 1e-13);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_P(CholeskyOfGrid, TakesAnOrderAndGoesBackToItsOwn) {
  const SparseMatrix K = grid_laplacian(GetParam(), 0.1);
  const VectorXd b = random_vector(K.rows());
  std::vector<int> backwards(static_cast<std::size_t>(K.rows()));
  std::iota(backwards.rbegin(), backwards.rend(), 0);
  VectorXd x, own, own_again;
  Cholesky cholesky;
  cholesky.analyze(K);
  const double n_entries = cholesky.n_factor_entries();
  ASSERT_TRUE(cholesky.factorize(K));
  cholesky.solve(b, own);

  cholesky.analyze(K, backwards);
  EXPECT_GE(cholesky.n_factor_entries(), n_entries) << "a band is fuller";
  ASSERT_TRUE(cholesky.factorize(K));
  cholesky.solve(b, x);
  EXPECT_LT(relative_residual(K, x, b), 1e-13);

  cholesky.analyze(K);
  EXPECT_EQ(cholesky.n_factor_entries(), n_entries);
  ASSERT_TRUE(cholesky.factorize(K));
  cholesky.solve(b, own_again);
  EXPECT_EQ(own, own_again);
}

TEST_P(CholeskyOfGrid, HasAsFewEntriesInOrderOfMinimumDegreeAsInItsOwn) {
  const SparseMatrix K = grid_laplacian(GetParam(), 0.1);
  const auto n = static_cast<std::size_t>(K.rows()), n_entries = static_cast<std::size_t>(K.nonZeros());
  std::vector<int> order =
      minimum_degree_order(std::span(K.outerIndexPtr(), n + 1), std::span(K.innerIndexPtr(), n_entries));
  Cholesky own, ordered;
  own.analyze(K);
  ordered.analyze(K, order);
  EXPECT_LE(ordered.n_factor_entries(), 1.01 * own.n_factor_entries());
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), all.begin(), all.end()));
}

TEST_P(CholeskyOfGrid, GivesTheSameBytesEachTime) {
  const SparseMatrix K = grid_laplacian(GetParam(), 0.1);
  const VectorXd b = random_vector(K.rows());
  VectorXd first, second;
  for (VectorXd* x : {&first, &second}) {
    Cholesky cholesky;
    cholesky.analyze(K);
    ASSERT_TRUE(cholesky.factorize(K));
    cholesky.solve(b, *x);
  }
  EXPECT_EQ(first, second);
}

TEST(Cholesky, FindsOneNegativePivotAmongMany) {
  for (const int side : {20, 150}) {
    SparseMatrix K = grid_laplacian(side, 0.1);
    K.coeffRef(side, side) = -1e-3;
    Cholesky cholesky;
    cholesky.analyze(K);
    EXPECT_FALSE(cholesky.factorize(K));
    EXPECT_GE(cholesky.failed_row(), 0);
    EXPECT_TRUE(cholesky.factorize(grid_laplacian(side, 0.1)));
    EXPECT_EQ(cholesky.failed_row(), -1);
  }
}

TEST(Cholesky, CanBeAnalyzedAnewAndMoved) {
  Cholesky cholesky;
  VectorXd x;
  for (const int side : {7, 3, 12}) {
    const SparseMatrix K = grid_laplacian(side, 1);
    const VectorXd b = random_vector(K.rows());
    cholesky.analyze(K);
    ASSERT_TRUE(cholesky.factorize(K));
    Cholesky moved = std::move(cholesky);
    moved.solve(b, x);
    EXPECT_LT(relative_residual(K, x, b), 1e-13);
    cholesky = std::move(moved);
  }
  EXPECT_EQ(cholesky.n_analyses(), 3);
}

// Eliminating the hub of a star first makes a full matrix of its rim.
TEST(Cholesky, AFactorOfTooManyEntriesIsRefusedByItsSize) {
  const int n = 70000;
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < n; ++k) entries.emplace_back(k, k, n);
  for (int k = 1; k < n; ++k) entries.emplace_back(k, 0, -1);
  SparseMatrix star(n, n);
  star.setFromTriplets(entries.begin(), entries.end());
  std::vector<int> hub_first(static_cast<std::size_t>(n));
  std::iota(hub_first.begin(), hub_first.end(), 0);
  Cholesky cholesky;
  try {
    cholesky.analyze(star, hub_first);
    FAIL() << "accepted";
  } catch (const OutOfMemory& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("70000 rows"), std::string::npos) << what;
    EXPECT_NE(what.find("too large for 32-bit indices"), std::string::npos) << what;
  }
}

}  // namespace
