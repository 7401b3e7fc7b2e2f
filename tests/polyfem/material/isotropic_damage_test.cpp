#include <polyfem/material/isotropic_damage.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace polyfem;

namespace {

constexpr double young = 30e9, poisson = 0.2;
const DamageMaterial concrete{.elasticity = elasticity_matrix(young, poisson, Plane::stress),
                              .young = young,
                              .onset = 1e-4,
                              .softening = 4e-4};

Vec3 uniaxial(double strain) {
  return {strain, -poisson * strain, 0};
}

TEST(IsotropicDamage, SoftensAsTheClosedFormSays) {
  double history = 0;
  for (const double strain : {0.5e-4, 1e-4, 1.2e-4, 3e-4, 2e-3}) {
    const DamageStep step = damage_step(concrete, uniaxial(strain), history);
    const double stress = strain <= 1e-4 ? young * strain : young * 1e-4 * std::exp(-(strain - 1e-4) / 4e-4);
    EXPECT_NEAR(step.stress[0] / stress, 1, 1e-10);
    EXPECT_LT(std::abs(step.stress[1]) + std::abs(step.stress[2]), 1e-10 * stress);
    history = step.largest_strain;
  }
  const DamageStep back = damage_step(concrete, uniaxial(1e-3), history);  // to the origin, along a secant
  EXPECT_NEAR(back.stress[0] / (young * 1e-4 * std::exp(-(2e-3 - 1e-4) / 4e-4) / 2), 1, 1e-10);
  EXPECT_EQ(back.largest_strain, history);
}

TEST(IsotropicDamage, CostsItsFractureEnergy) {
  double work = 0, history = 0, before = 0;
  constexpr int n_steps = 10000;
  constexpr double last = 1e-2;  // exp(-25) of the strength is left there
  for (int k = 1; k <= n_steps; ++k) {
    const DamageStep step = damage_step(concrete, uniaxial(last * k / n_steps), history);
    work += (before + step.stress[0]) / 2 * last / n_steps;
    before = step.stress[0];
    history = step.largest_strain;
  }
  EXPECT_NEAR(work / (young * 1e-4 * (1e-4 / 2 + 4e-4)), 1, 1e-6);
}

TEST(IsotropicDamage, TangentIsTheDerivativeOfStress) {
  const Vec3 strain(3e-4, -1e-4, 2e-4);
  for (const double history : {0., 2e-4, 1e-3}) {  // loading twice, then unloading
    const DamageStep step = damage_step(concrete, strain, history);
    const double h = 1e-9;
    for (int k = 0; k < 3; ++k) {
      const Vec3 slope = (damage_step(concrete, strain + h * Vec3::Unit(k), history).stress -
                          damage_step(concrete, strain - h * Vec3::Unit(k), history).stress) /
                         (2 * h);
      EXPECT_LT((slope - step.tangent.col(k)).norm(), 1e-8 * young);
    }
    EXPECT_LT((step.tangent - step.tangent.transpose()).norm(), 1e-15 * young);
    EXPECT_GT(step.damage, 0);
    EXPECT_LT(step.damage, 1);
  }
}

TEST(IsotropicDamage, IsElasticBelowItsOnset) {
  for (const Vec3& strain : {Vec3(0, 0, 0), Vec3(3e-5, -2e-5, 1e-5)}) {
    const DamageStep step = damage_step(concrete, strain, 0);
    EXPECT_EQ(step.stress, concrete.elasticity * strain);
    EXPECT_EQ(step.tangent, concrete.elasticity);
    EXPECT_EQ(step.damage, 0);
  }
}

}  // namespace
