#include <ddacontact/block/integration.hpp>
#include <polyfem/element/definiteness.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using polyfem::GradientCorrection;

namespace {

bool is_definite(const Points& outline, const Integration& integration) {
  polyfem::TabulatedElement element;
  tabulate(outline, *integration.triangle_rule, polyfem::wachspress, integration.correction, element);
  MatrixXd K, M;
  polyfem::stiffness(element, polyfem::elasticity_matrix(2e9, 0.3, polyfem::Plane::strain), K);
  polyfem::mass(element, M);
  return polyfem::judge(K, M).definite();
}

}  // namespace

TEST(Integration, IsThePapersWithoutCorrectionWhetherDefiniteOrNot) {
  std::mt19937 random(6);
  for (int n = 3; n < 60; ++n) {
    const Points outline = support::random_convex_polygon(n, random);
    const Integration chosen = choose_integration(outline, GradientCorrection::off);
    EXPECT_EQ(chosen.triangle_rule, &polyfem::hammer_rule(3));
    EXPECT_EQ(chosen.definite, is_definite(outline, chosen)) << n;
  }
}

TEST(Integration, IsTheCheapestDefiniteRuleWithCorrection) {
  std::mt19937 random(6);
  int finer = 0;
  for (int n = 3; n < 40; ++n) {
    const Points outline = n % 2 ? support::regular_polygon(n) : support::random_convex_polygon(n, random);
    const Integration chosen = choose_integration(outline, GradientCorrection::on);
    EXPECT_TRUE(chosen.definite && is_definite(outline, chosen)) << n;
    EXPECT_EQ(chosen.correction, GradientCorrection::on);
    for (const int degree : {3, 5}) {
      const polyfem::TriangleRule* cheaper = &polyfem::hammer_rule(degree);
      if (chosen.triangle_rule == cheaper) break;
      ++finer;
      EXPECT_FALSE(is_definite(outline, {cheaper, GradientCorrection::on})) << n;
    }
  }
  EXPECT_GT(finer, 0);
}
