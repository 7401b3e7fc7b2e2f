#include <ddacontact/solver/anderson.hpp>

#include <gtest/gtest.h>

#include <Eigen/LU>

using namespace ddacontact;

namespace {

/// x <- x + f(x), f = b - A x, with eigenvalues of I - A up to 9 in magnitude.
struct LinearIteration {
  MatrixXd A;
  VectorXd solution;

  explicit LinearIteration(int n) : solution(VectorXd::LinSpaced(n, 1, 2)) {
    const MatrixXd V = MatrixXd::Identity(n, n) + 0.1 * MatrixXd::Ones(n, n);
    A = V * VectorXd::LinSpaced(n, 0.5, 10).asDiagonal() * V.inverse();
  }
  VectorXd f(const VectorXd& x) const { return A * (solution - x); }
};

}  // namespace

TEST(AndersonAcceleration, SolvesALinearIterationThatDivergesByItself) {
  const int n = 6;
  const LinearIteration iteration(n);
  VectorXd plain = VectorXd::Zero(n), x = plain;
  AndersonAcceleration acceleration(8);
  for (int k = 0; k <= n; ++k) {
    plain += iteration.f(plain);
    acceleration.advance(iteration.f(x), VectorXd::Ones(n), x);
  }
  EXPECT_GT((plain - iteration.solution).norm(), 1e3);
  EXPECT_LT((x - iteration.solution).norm(), 1e-9);
}

TEST(AndersonAcceleration, TheFirstStepAndTheFirstAfterAResetArePlain) {
  const LinearIteration iteration(4);
  AndersonAcceleration acceleration(8);
  VectorXd x = VectorXd::Zero(4);
  for (int k = 0; k < 3; ++k) {
    const VectorXd before = x, f = iteration.f(x);
    acceleration.advance(f, VectorXd::Ones(4), x);
    if (k > 0) continue;
    EXPECT_EQ(x, before + f);
  }
  acceleration.reset();
  const VectorXd before = x, f = iteration.f(x);
  acceleration.advance(f, VectorXd::Ones(4), x);
  EXPECT_EQ(x, before + f);
}

/// A zero weight takes an entry out of the least squares: the others are then met exactly by fewer
/// differences.
TEST(AndersonAcceleration, WeightsSayWhichEntriesCount) {
  AndersonAcceleration acceleration(8);
  const auto f = [](const VectorXd& v) -> VectorXd {
    return Eigen::Vector2d(3 * (1 - v[0]), 0.1 * (1 - v[1]));
  };
  VectorXd x = VectorXd::Zero(2);
  for (int k = 0; k < 2; ++k) acceleration.advance(f(x), Eigen::Vector2d(1, 0), x);
  EXPECT_NEAR(x[0], 1, 1e-12);
}
