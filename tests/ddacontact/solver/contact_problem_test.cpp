#include <ddacontact/solver/contact_problem.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace ddacontact;

namespace {

/// A diagonal body of 3 unknowns, a dense one of 4, and two contacts: between them and with what does not
/// move.
struct TwoBodies {
  std::mt19937 random{5};
  ContactProblem problem;

  VectorXd vector(int n) {
    std::normal_distribution<double> normal;
    return VectorXd::NullaryExpr(n, [&] { return normal(random); });
  }
  TwoBodies() {
    const VectorXd mass = vector(3).cwiseAbs() + VectorXd::Ones(3);
    MatrixXd root(4, 4);
    for (int j = 0; j < 4; ++j) root.col(j) = vector(4);
    problem.add_body(mass, vector(3));
    problem.add_body(MatrixXd(root * root.transpose() + MatrixXd::Identity(4, 4)), vector(4));
    CoulombLaw law;
    law.friction = 0.5;
    const VectorXd none;
    problem.add_contact({0, vector(3), vector(3)}, {1, vector(4), vector(4)}, {0.25, -0.5}, law);
    problem.add_contact({-1, none, none}, {1, vector(4), vector(4)}, {0.5, 0.125}, law);
  }
};

}  // namespace

TEST(ContactProblem, ResponseIsTheChangeOfRatesByAUnitImpulse) {
  TwoBodies t;
  const VectorXd z = t.problem.velocity();
  for (int c = 0; c < 2; ++c) {
    const NormalAndShear before = t.problem.rates(c, z);
    NormalAndShear& impulse = t.problem.impulses[static_cast<std::size_t>(c)];
    impulse = {1, 0};
    const NormalAndShear by_normal = t.problem.rates(c, t.problem.velocity());
    impulse = {0, 1};
    const NormalAndShear by_shear = t.problem.rates(c, t.problem.velocity());
    impulse = {};
    EXPECT_NEAR(by_normal.normal - before.normal, t.problem.response(c).normal, 1e-13);
    EXPECT_NEAR(by_shear.shear - before.shear, t.problem.response(c).shear, 1e-13);
    EXPECT_NEAR(by_normal.shear - before.shear, t.problem.cross_response(c), 1e-13);
    EXPECT_NEAR(by_shear.normal - before.normal, t.problem.cross_response(c), 1e-13);
  }
}

TEST(ContactProblem, VelocityBalancesMomentum) {
  TwoBodies t;
  t.problem.impulses = {{2, -1}, {3, 0.5}};
  const VectorXd change = t.problem.velocity() - t.problem.free_velocity();
  for (int b = 0; b < 2; ++b) {
    VectorXd left = VectorXd::Zero(t.problem.count(b));
    t.problem.add_mass_times(b, change.data() + t.problem.first(b), 1, left.data());
    for (int c = 0; c < 2; ++c)
      for (const int side : {0, 1}) {
        if (t.problem.body(c, side) != b) continue;
        const auto normal = t.problem.normal_row(c, side), shear = t.problem.shear_row(c, side);
        for (int i = 0; i < left.size(); ++i)
          left[i] -=
              normal[static_cast<std::size_t>(i)] * t.problem.impulses[static_cast<std::size_t>(c)].normal +
              shear[static_cast<std::size_t>(i)] * t.problem.impulses[static_cast<std::size_t>(c)].shear;
      }
    EXPECT_LT(left.lpNorm<Eigen::Infinity>(), 1e-12);
  }
}

TEST(ContactProblem, ResponseUndoesMass) {
  TwoBodies t;
  for (int b = 0; b < 2; ++b) {
    const VectorXd x = t.vector(t.problem.count(b));
    VectorXd y = VectorXd::Zero(x.size()), back = VectorXd::Zero(x.size());
    t.problem.add_mass_times(b, x.data(), 2, y.data());
    t.problem.add_response(b, y.data(), 0.5, back.data());
    EXPECT_LT((back - x).norm(), 1e-12 * x.norm());
  }
}

TEST(ContactProblem, APartHasTheSameRates) {
  TwoBodies t;
  t.problem.impulses[1] = {2, 1};
  t.problem.body_scale = {1, 3};
  const std::vector<int> bodies{1}, contacts{1};
  const ContactProblem part = t.problem.part(bodies, contacts);
  const NormalAndShear whole = t.problem.rates(1, t.problem.velocity()),
                       alone = part.rates(0, part.velocity());
  EXPECT_EQ(whole.normal, alone.normal);
  EXPECT_EQ(whole.shear, alone.shear);
  EXPECT_EQ(part.body_scale.at(0), 3);
  EXPECT_EQ(part.impulses.at(0).normal, 2);
}

TEST(ContactProblem, ResidualIsRelativeToTheImpulsesOfTheLesserBody) {
  ContactProblem problem;
  CoulombLaw law;
  const VectorXd one = VectorXd::Ones(1), zero = VectorXd::Zero(1);
  problem.add_body(one, VectorXd::Constant(1, -1.0));
  problem.add_body(VectorXd::Constant(1, 1e6), zero);
  problem.add_contact({0, one, zero}, {1, VectorXd(-one), zero}, {}, law);
  problem.body_scale = {4, 1e9};
  EXPECT_NEAR(residual(problem, problem.velocity()).relative, 0.25, 1e-5);
  EXPECT_EQ(residual(problem, problem.velocity()).contact, 0);
}

TEST(ContactProblem, ADirectionThatNothingMovesInHasAPositiveResponse) {
  ContactProblem problem;
  const VectorXd one = VectorXd::Ones(1), zero = VectorXd::Zero(1), none;
  problem.add_body(one, zero);
  problem.add_contact({0, one, zero}, {-1, none, none}, {}, CoulombLaw{});
  EXPECT_GT(problem.response(0).shear, 0);
}

TEST(ContactProblem, VelocitiesThatAreNotNumbersAreAnInfiniteResidual) {
  TwoBodies t;
  t.problem.impulses[0].normal = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(residual(t.problem, t.problem.velocity()).relative, std::numeric_limits<double>::infinity());
}
