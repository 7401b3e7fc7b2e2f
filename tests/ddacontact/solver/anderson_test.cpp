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
    const VectorXd f = iteration.f(x);
    x += f;
    acceleration.advance(f, x);
  }
  EXPECT_GT((plain - iteration.solution).norm(), 1e3);
  EXPECT_LT((x - iteration.solution).norm(), 1e-9);
}

TEST(AndersonAcceleration, TheFirstStepAndTheFirstAfterAResetArePlain) {
  const LinearIteration iteration(4);
  AndersonAcceleration acceleration(8);
  VectorXd x = VectorXd::Zero(4);
  for (int k = 0; k < 3; ++k) {
    const VectorXd f = iteration.f(x), plain = x + f;
    x = plain;
    acceleration.advance(f, x);
    if (k > 0) continue;
    EXPECT_EQ(x, plain);
  }
  acceleration.reset();
  const VectorXd f = iteration.f(x), plain = x + f;
  x = plain;
  acceleration.advance(f, x);
  EXPECT_EQ(x, plain);
}

/// What is not measured follows: the second unknown, far from its end, moves as the first one asks.
TEST(AndersonAcceleration, WhatIsNotMeasuredFollowsLinearly) {
  AndersonAcceleration acceleration(8);
  Eigen::VectorXd x = VectorXd::Zero(2);  // the second is always twice the first
  for (int k = 0; k < 2; ++k) {
    const double f = 3 * (1 - x[0]);
    x += Eigen::Vector2d(f, 2 * f);
    acceleration.advance(VectorXd::Constant(1, f), x);
  }
  EXPECT_NEAR(x[0], 1, 1e-12);
  EXPECT_NEAR(x[1], 2, 1e-12);
}

/// More differences than are kept, and differences of zero.
TEST(AndersonAcceleration, KeepsTheLastFew) {
  const int n = 6;
  const LinearIteration iteration(n);
  VectorXd x = iteration.solution * 0.999;
  AndersonAcceleration acceleration(2);
  for (int k = 0; k < 60; ++k) {
    const VectorXd f = 0.1 * iteration.f(x);
    x += f;
    acceleration.advance(f, x);
  }
  EXPECT_LT((x - iteration.solution).norm(), 1e-9);
  acceleration.advance(VectorXd::Zero(n), x);
  acceleration.advance(VectorXd::Zero(n), x);
  EXPECT_TRUE(x.allFinite());
}
