#include <polyfem/material/j2_plasticity.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace polyfem;

namespace {

const J2Material material{.bulk = 2, .shear = 0.8, .yield_stress = 0.01, .hardening = 0.1};

TEST(J2Plasticity, IsElasticBelowTheYieldStress) {
  const double poisson = (3 * 2 - 2 * 0.8) / (2 * (3 * 2 + 0.8)), young = 2 * 0.8 * (1 + poisson);
  const Mat3 D = elasticity_matrix(young, poisson, Plane::strain);
  const Vec3 strain(1e-3, -2e-3, 1e-3);
  const PlasticStep step = j2_step(material, strain, {});
  EXPECT_LT((step.stress - D * strain).norm(), 1e-16);
  EXPECT_LT((step.tangent - D).norm(), 1e-14);
  EXPECT_EQ(step.state.equivalent, 0);
}

TEST(J2Plasticity, ShearsAsTheClosedFormSays) {
  // tau = k + (gamma - k / mu) H mu / (H + 3 mu), k = yield stress / sqrt(3)
  const double gamma = 0.05, mu = material.shear, H = material.hardening, k = 0.01 / std::sqrt(3);
  PlasticState state;
  for (const double part : {0.2, 0.5, 1.}) {
    const PlasticStep step = j2_step(material, Vec3(0, 0, part * gamma), state);
    EXPECT_NEAR(step.stress[2], k + (part * gamma - k / mu) * H * mu / (H + 3 * mu), 1e-15);
    EXPECT_LT(std::abs(step.stress[0]) + std::abs(step.stress[1]) + std::abs(step.stress_zz), 1e-16);
    state = step.state;
  }
  const PlasticStep back = j2_step(material, Vec3(0, 0, gamma - 1e-3), state);
  EXPECT_NEAR(back.tangent(2, 2), mu, 1e-15) << "unloads elastically";
}

TEST(J2Plasticity, EndsOnTheYieldSurfaceWithoutPlasticVolume) {
  const PlasticStep step = j2_step(material, Vec3(0.03, -0.01, 0.02), {});
  const double mean = (step.stress[0] + step.stress[1] + step.stress_zz) / 3;
  const double mises =
      std::sqrt(1.5 * (std::pow(step.stress[0] - mean, 2) + std::pow(step.stress[1] - mean, 2) +
                       std::pow(step.stress_zz - mean, 2) + 2 * std::pow(step.stress[2], 2)));
  EXPECT_NEAR(mises, 0.01 + 0.1 * step.state.equivalent, 1e-15);
  EXPECT_NEAR(step.state.strain.head<3>().sum(), 0, 1e-17);
}

TEST(J2Plasticity, TangentIsTheDerivativeOfStress) {
  const PlasticState before = j2_step(material, Vec3(0.01, 0, -0.02), {}).state;
  const Vec3 strain(0.02, -0.01, 0.01);
  const PlasticStep step = j2_step(material, strain, before);
  const double h = 1e-7;
  for (int k = 0; k < 3; ++k) {
    const Vec3 slope = (j2_step(material, strain + h * Vec3::Unit(k), before).stress -
                        j2_step(material, strain - h * Vec3::Unit(k), before).stress) /
                       (2 * h);
    EXPECT_LT((slope - step.tangent.col(k)).norm(), 1e-8);
  }
  EXPECT_LT((step.tangent - step.tangent.transpose()).norm(), 1e-16);
}

}  // namespace
