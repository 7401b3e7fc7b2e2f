#include <ddacontact/solver/friction_bounds.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace ddacontact;

namespace {

/// b = max(0, A b + c) with A of norm `gain` that turns: the plain iteration diverges when it is above 1.
struct Turning {
  MatrixXd A{2, 2};
  VectorXd c{2};
  int calls = 0;
  Turning(double gain, double c_0) {
    A << 0, -gain, gain, 0;
    c << c_0, 1;
  }
  bool find(VectorXd& bounds) {
    return iterate_bounds(
        [&](const VectorXd& b, VectorXd& wanted) {
          ++calls;
          EXPECT_GE(b.minCoeff(), 0);
          wanted = (A * b + c).cwiseMax(0);
        },
        bounds);
  }
};

}  // namespace

TEST(FrictionBounds, SettleWhereTheyAgreeAlsoWhenThePlainIterationDiverges) {
  for (auto [gain, c_0] : {std::pair(0., 3.), {0.3, 3}, {0.9, 3}, {1.2, 3}, {2, 3}, {0.9, 0.2}, {2, 1}}) {
    Turning turning(gain, c_0);
    VectorXd bounds = VectorXd::Zero(2);
    const bool settled = turning.find(bounds);
    EXPECT_TRUE(settled) << gain;
    EXPECT_LE((bounds - (turning.A * bounds + turning.c).cwiseMax(0)).norm(), 2e-9 * bounds.norm()) << gain;
    EXPECT_LE(turning.calls, 15) << gain;
  }
}

/// Contacts that change their states: the slope is -4 about the solution and 0 away from it, so that
/// accelerated steps may jump across it for ever.
TEST(FrictionBounds, SettleWhenContactsChangeTheirStates) {
  VectorXd bounds = VectorXd::Constant(1, 9);
  const bool settled = iterate_bounds(
      [](const VectorXd& b, VectorXd& wanted) {
        wanted = VectorXd::Constant(1, std::clamp(1 - 4 * (b[0] - 1), 0.2, 1.8));
      },
      bounds);
  EXPECT_TRUE(settled);
  EXPECT_NEAR(bounds[0], 1, 1e-8);
}

TEST(FrictionBounds, WithoutSolutionTheIterationEnds) {
  VectorXd bounds = VectorXd::Zero(1);
  int solves = 0;
  const bool settled = iterate_bounds(
      [&](const VectorXd& b, VectorXd& wanted) {
        ++solves;
        wanted = VectorXd::Constant(1, b[0] > 1 ? 0 : 2);
      },
      bounds);
  EXPECT_FALSE(settled);
  EXPECT_EQ(solves, 100);
}

TEST(FrictionBounds, WithoutFrictionOneSolveIsEnough) {
  for (Index n : {0, 3}) {
    VectorXd bounds = VectorXd::Zero(n);
    int solves = 0;
    const bool settled = iterate_bounds(
        [&](const VectorXd&, VectorXd& wanted) {
          ++solves;
          wanted.setZero(n);
        },
        bounds);
    EXPECT_TRUE(settled);
    EXPECT_EQ(solves, 1);
  }
}
