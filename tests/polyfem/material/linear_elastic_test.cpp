#include <polyfem/core/error.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace polyfem;

namespace {

constexpr double young = 35e9, poisson = 0.23;
const double shear_modulus = young / (2 * (1 + poisson));

TEST(ElasticityMatrix, InPlaneStressGivesHookesStrainUnderTension) {
  const Vec3 stress = elasticity_matrix(young, poisson, Plane::stress) * Vec3(1e-4, -poisson * 1e-4, 0);
  EXPECT_NEAR(stress[0], young * 1e-4, 1e-14 * young);
  EXPECT_NEAR(stress[1], 0, 1e-19 * young);
}

TEST(ElasticityMatrix, InPlaneStrainIsThePlaneOfThreeDimensionalElasticity) {
  const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  Mat3 expected;
  expected << lame + 2 * shear_modulus, lame, 0,  //
      lame, lame + 2 * shear_modulus, 0,          //
      0, 0, shear_modulus;
  EXPECT_TRUE(elasticity_matrix(young, poisson, Plane::strain).isApprox(expected, 1e-15));
}

class ElasticityMatrixInPlane : public testing::TestWithParam<Plane> {};
INSTANTIATE_TEST_SUITE_P(Planes, ElasticityMatrixInPlane, testing::Values(Plane::strain, Plane::stress));

TEST_P(ElasticityMatrixInPlane, ShearsWithTheShearModulus) {
  EXPECT_NEAR(elasticity_matrix(young, poisson, GetParam())(2, 2), shear_modulus, 1e-15 * young);
}

TEST_P(ElasticityMatrixInPlane, IsThePositiveDefiniteSymmetricOfAnIsotropicBody) {
  for (const double nu : {-0.9, -0.3, 0., 0.25, 0.49}) {
    const Mat3 D = elasticity_matrix(1, nu, GetParam());
    EXPECT_EQ(D, D.transpose());
    EXPECT_NEAR(D(0, 0) - D(0, 1), 2 * D(2, 2), 1e-13 * D(0, 0));
    EXPECT_GT(D(2, 2), 0);
    EXPECT_GT(D(0, 0), std::abs(D(0, 1)));
  }
}

TEST_P(ElasticityMatrixInPlane, RefusesImpossibleConstants) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0., -1., nan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(elasticity_matrix(bad, 0.3, GetParam()), Error);
  for (const double bad : {-1., 0.5, 0.6, nan}) EXPECT_THROW(elasticity_matrix(1, bad, GetParam()), Error);
}

Vec3 stress_of(double s1, double s2, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {s1 * c * c + s2 * s * s, s1 * s * s + s2 * c * c, (s1 - s2) * c * s};
}

TEST(PrincipalStresses, AreFoundAgainAfterRotation) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angles(-std::numbers::pi / 2, std::numbers::pi / 2), stresses(-1, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    const double a = stresses(random), b = stresses(random), angle = angles(random);
    const double s1 = std::max(a, b), s2 = std::min(a, b);
    const PrincipalStresses found = principal_stresses(stress_of(s1, s2, angle));
    EXPECT_NEAR(found.s1, s1, 1e-15);
    EXPECT_NEAR(found.s2, s2, 1e-15);
    EXPECT_NEAR(std::sin(found.angle - angle), 0, 1e-15 / (s1 - s2));
  }
}

TEST(PrincipalStresses, HaveAnAngleInTheHalfOpenInterval) {
  constexpr double right = std::numbers::pi / 2;
  EXPECT_EQ(principal_stresses({2, 1, 0.}).angle, 0);
  EXPECT_EQ(principal_stresses({1, 2, 0.}).angle, right);
  EXPECT_EQ(principal_stresses({1, 2, -0.}).angle, right);
  EXPECT_EQ(principal_stresses({1, 2, -1e-300}).angle, right);
  EXPECT_DOUBLE_EQ(principal_stresses({0, 0, 1}).angle, right / 2);
  EXPECT_DOUBLE_EQ(principal_stresses({0, 0, -1}).angle, -right / 2);
  EXPECT_EQ(principal_stresses({1, 1, 0}).s1, principal_stresses({1, 1, 0}).s2);
}

}  // namespace
