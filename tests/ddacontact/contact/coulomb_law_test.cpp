#include <ddacontact/contact/coulomb_law.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace ddacontact;

namespace {

constexpr NormalAndShear response{0.5, 0.25};

CoulombLaw rough(double friction) {
  CoulombLaw law;
  law.friction = friction;
  return law;
}

double largest(const NormalAndShear& x) {
  return std::max(std::abs(x.normal), std::abs(x.shear));
}

}  // namespace

TEST(CoulombLaw, HasNoResidualWhereItHolds) {
  const CoulombLaw law = rough(0.5);
  EXPECT_EQ(largest(law.residual({0, 0}, {2, -3}, response)), 0) << "open";
  EXPECT_EQ(largest(law.residual({4, 1}, {0, 0}, response)), 0) << "stick";
  EXPECT_EQ(largest(law.residual({4, 2}, {0, -1}, response)), 0) << "slips backward";
  EXPECT_EQ(largest(law.residual({4, -2}, {0, 1}, response)), 0) << "slips forward";
}

TEST(CoulombLaw, HasAResidualWhereItIsViolated) {
  const CoulombLaw law = rough(0.5);
  EXPECT_GT(largest(law.residual({0, 0}, {-1, 0}, response)), 0) << "penetrates";
  EXPECT_GT(largest(law.residual({-1, 0}, {0, 0}, response)), 0) << "pulls";
  EXPECT_GT(largest(law.residual({4, 0}, {1, 0}, response)), 0) << "presses although it opens";
  EXPECT_GT(largest(law.residual({4, 3}, {0, 0}, response)), 0) << "beyond the bound";
  EXPECT_GT(largest(law.residual({4, 2}, {0, 1}, response)), 0) << "pushes along the slip";
  EXPECT_GT(largest(law.residual({4, 1}, {0, 1}, response)), 0) << "slips below the bound";
}

TEST(CoulombLaw, ComplianceGivesWayInProportion) {
  CoulombLaw law = rough(0.5);
  law.normal_compliance = 0.125;
  law.shear_compliance = 0.0625;
  EXPECT_EQ(largest(law.residual({4, 1}, {-0.5, -0.0625}, response)), 0);
  EXPECT_GT(largest(law.residual({4, 1}, {0, 0}, response)), 0);
}

TEST(CoulombLaw, ResidualOfACompliantContactIsTheErrorOfItsImpulse) {
  // u = u_0 + w p, and p is too large by 1e-3.
  CoulombLaw law;
  law.normal_compliance = 1e3;
  const double p = 1, error = 1e-3, u_0 = -(response.normal + law.normal_compliance) * p;
  const NormalAndShear left =
      law.residual({p + error, 0}, {u_0 + response.normal * (p + error), 0}, response);
  EXPECT_NEAR(left.normal, error, 1e-12);
}

TEST(CoulombLaw, BondsBearAnyImpulseAndNeverMove) {
  CoulombLaw law;
  law.bonded = true;
  EXPECT_EQ(largest(law.residual({-7, 9}, {0, 0}, response)), 0);
  EXPECT_GT(largest(law.residual({-7, 9}, {1, 0}, response)), 0);
  EXPECT_GT(largest(law.residual({-7, 9}, {0, 1}, response)), 0);
  const NormalAndShear kept = law.project({-7, 9});
  EXPECT_EQ(kept.normal, -7);
  EXPECT_EQ(kept.shear, 9);
}

TEST(CoulombLaw, BoundRateIsTheDerivativeOfTheBound) {
  const FrictionLaw saturating = [](double force) { return 3 * force / (1 + force); };
  CoulombLaw law;
  law.friction_law = &saturating;
  law.time = 0.01;
  for (const double p : {1e-6, 1e-3, 0.01, 0.3, 5.0}) {
    const double force = p / law.time, exact = 3 / ((1 + force) * (1 + force));
    EXPECT_NEAR(law.bound_rate(p), exact, 1e-6 * exact + 1e-9);
    EXPECT_NEAR(law.bound(p), law.time * 3 * force / (1 + force), 1e-15);
  }
}

TEST(CoulombLaw, ProjectionStaysWhatItIs) {
  const CoulombLaw law = rough(0.7);
  for (const NormalAndShear trial : {NormalAndShear{-1, 2}, {3, 9}, {3, -9}, {3, 1}}) {
    const NormalAndShear once = law.project(trial), twice = law.project(once);
    EXPECT_EQ(once.normal, twice.normal);
    EXPECT_EQ(once.shear, twice.shear);
    EXPECT_LE(std::abs(once.shear), law.bound(once.normal));
  }
}
