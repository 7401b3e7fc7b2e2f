/// \file The derivative of the shear bound against differences; the bound itself is in spring_law_test.
#include <ddacontact/contact/joint_law.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace ddacontact;

/// The difference quotient of the bound.
double rate_by_differences(const JointLaw& law, double normal, bool bonded) {
  const double step = 1e-3 * std::abs(normal);
  return (shear_bound(law, normal + step, bonded) - shear_bound(law, normal - step, bonded)) / (2 * step);
}

TEST(JointLaw, RateIsTheDerivativeOfTheBound) {
  const JointLaw law{.friction = 0.6, .cohesion = 50};
  for (const bool bonded : {false, true})
    EXPECT_NEAR(friction_rate(law, 200, bonded), rate_by_differences(law, 200, bonded), 1e-12);
  // The bound of a bond that is pulled does not change; without a bond Coulomb's line goes on for Newton's
  // method.
  EXPECT_EQ(friction_rate(law, -10, true), 0);
  EXPECT_EQ(rate_by_differences(law, -10, true), 0);
  EXPECT_DOUBLE_EQ(friction_rate(law, -10, false), 0.6);

  const FrictionLaw root = [](double normal) { return std::sqrt(normal); };
  EXPECT_NEAR(friction_rate({.friction = 0.6, .friction_law = &root}, 100, false), 0.05, 1e-6);
}

}  // namespace
