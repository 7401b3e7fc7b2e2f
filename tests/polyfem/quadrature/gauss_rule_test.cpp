#include <polyfem/quadrature/gauss_rule.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace polyfem;

namespace {

class Gauss : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Points, Gauss, testing::Values(1, 2, 3, 5, 10, 20, 64));

TEST_P(Gauss, IntegratesItsDegree) {
  const GaussRule& rule = gauss_rule(GetParam());
  EXPECT_GT(rule.weights.minCoeff(), 0);
  for (int degree = 0; degree < 2 * GetParam(); ++degree)
    EXPECT_NEAR(rule.points.array().pow(degree).matrix().dot(rule.weights), 1. / (degree + 1), 4e-16 * 4);
}

TEST_P(Gauss, IsTheSameComputedAfresh) {
  EXPECT_EQ(gauss_rule(GetParam()).points, gauss_legendre(GetParam()).points);
}

/// The relative error of the integral of 1 / ((t + before)(1 + behind - t)).
double error_with_poles(const GaussRule& rule, const Reach& reach) {
  const double exact =
      (std::log1p(1 / reach.before) + std::log1p(1 / reach.behind)) / (1 + reach.before + reach.behind);
  const auto t = rule.points.array();
  return std::abs(((t + reach.before) * (1 + reach.behind - t)).inverse().matrix().dot(rule.weights) / exact -
                  1);
}

class GradedGauss : public testing::TestWithParam<Reach> {};
INSTANTIATE_TEST_SUITE_P(Reaches, GradedGauss,
                         testing::Values(Reach{1, 1}, Reach{1e6, 1e-2}, Reach{1e-4, 1}, Reach{1e-3, 1e-5},
                                         Reach{1e6, 1e6}));

TEST_P(GradedGauss, MakesSimplePolesAtItsReachVanish) {
  GaussRule rule;
  make_graded_gauss_rule(1, GradedMap(GetParam()), rule);
  EXPECT_LT(error_with_poles(rule, GetParam()), 1e-12);  // the integrand is constant in u
}

TEST_P(GradedGauss, ConvergesAsTheAxisOfTheEllipseSays) {
  // Poles at twice the reach: in u they lie on the lines Im u = +-pi.
  const Reach twice{2 * GetParam().before, 2 * GetParam().behind};
  const double y = 2 * std::numbers::pi / GradedMap(GetParam()).length();
  GaussRule rule;
  for (const double digits : {5., 10., 20., 30.}) {
    make_graded_gauss_rule(n_gauss_points(digits, std::sqrt(1 + y * y)), GradedMap(GetParam()), rule);
    EXPECT_LT(error_with_poles(rule, twice), 10 * std::exp(-digits) + 1e-13);
  }
}

TEST_P(GradedGauss, HasPositiveWeightsThatSumToOneAndPointsInside) {
  GaussRule rule;
  make_graded_gauss_rule(30, GradedMap(GetParam()), rule);
  EXPECT_GT(rule.weights.minCoeff(), 0);
  EXPECT_GT(rule.points.minCoeff(), 0);
  EXPECT_LT(rule.points.maxCoeff(), 1);
  EXPECT_NEAR(rule.weights.sum(), 1, 1e-7);
}

TEST(GradedGauss, IsPlainGaussForSmoothFunctions) {
  GaussRule rule;
  make_graded_gauss_rule(5, GradedMap({1e6, 1e6}), rule);
  EXPECT_LT((rule.points - gauss_rule(5).points).norm(), 1e-6);
  EXPECT_LT((rule.weights - gauss_rule(5).weights).norm(), 1e-6);
}

TEST(GradedGauss, TakesTheMostPointsWhereSingularitiesAreUnknown) {
  EXPECT_EQ(n_gauss_points(10, std::nan("")), 64);
  EXPECT_EQ(n_gauss_points(10, 1), 64);
  EXPECT_EQ(n_gauss_points(0, 2), 1);
}

}  // namespace
