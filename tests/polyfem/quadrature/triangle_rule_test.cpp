#include <polyfem/core/error.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace polyfem;

namespace {

double factorial(int n) {
  return std::tgamma(n + 1.);
}

/// The mean of L1^a L2^b L3^c over the triangle is 2 a! b! c! / (a + b + c + 2)!. The largest error of a rule
/// over all monomials of this degree.
double monomial_error(const TriangleRule& rule, int degree) {
  double worst = 0;
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; a + b <= degree; ++b) {
      const int c = degree - a - b;
      double mean = 0;
      for (Index q = 0; q < rule.weights.size(); ++q)
        mean += rule.weights[q] * std::pow(rule.points(0, q), a) * std::pow(rule.points(1, q), b) *
                std::pow(rule.points(2, q), c);
      const double exact = 2 * factorial(a) * factorial(b) * factorial(c) / factorial(degree + 2);
      worst = std::max(worst, std::abs(mean - exact));
    }
  return worst;
}

void expect_exactness(const TriangleRule& rule) {
  for (int degree = 0; degree <= rule.degree; ++degree)
    EXPECT_LT(monomial_error(rule, degree), 2e-15) << "degree " << degree;  // round-off of up to 400 terms
}

class HammerRule : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Degree, HammerRule, testing::Range(1, 6));

TEST_P(HammerRule, IntegratesItsDegreeAndNoMore) {
  const TriangleRule& rule = hammer_rule(GetParam());
  EXPECT_EQ(rule.degree, GetParam());
  expect_exactness(rule);
  EXPECT_GT(monomial_error(rule, rule.degree + 1), 1e-5);
}

TEST_P(HammerRule, HasPointsInsideTheTriangle) {
  const TriangleRule& rule = hammer_rule(GetParam());
  EXPECT_GT(rule.points.minCoeff(), 0);
  EXPECT_NEAR((rule.points.colwise().sum().array() - 1).abs().maxCoeff(), 0, 2e-16);
}

TEST(HammerRules, HaveTheUsualNumberOfPoints) {
  const int n_points[] = {1, 3, 4, 6, 7};
  for (int degree = 1; degree <= 5; ++degree)
    EXPECT_EQ(hammer_rule(degree).weights.size(), n_points[degree - 1]);
  EXPECT_THROW(hammer_rule(0), Error);
  EXPECT_THROW(hammer_rule(6), Error);
}

TEST(HammerRules, OfDegreeThreeIsThePapersEquation32) {
  const TriangleRule& rule = hammer_rule(3);
  EXPECT_EQ(rule.weights, (VectorXd(4) << -9. / 16, 25. / 48, 25. / 48, 25. / 48).finished());
  EXPECT_NEAR((rule.points.col(0) - Eigen::Vector3d::Constant(1. / 3)).norm(), 0, 2e-16);
  for (int q = 1; q < 4; ++q)
    for (int l = 0; l < 3; ++l) EXPECT_NEAR(rule.points(l, q), l == q - 1 ? 0.6 : 0.2, 2e-16);
}

/// The largest relative error over all monomials of this degree, summed in extended precision so that only
/// the rounding of points and weights is left.
double relative_monomial_error(const TriangleRule& rule, int degree) {
  long double worst = 0;
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; a + b <= degree; ++b) {
      const int c = degree - a - b;
      long double mean = 0;
      for (Index q = 0; q < rule.weights.size(); ++q) {
        const long double l1 = rule.points(0, q), l2 = rule.points(1, q);
        mean += rule.weights[q] * std::pow(l1, a) * std::pow(l2, b) * std::pow(1 - l1 - l2, c);
      }
      const long double exact =
          2 * std::tgamma(a + 1.L) * std::tgamma(b + 1.L) * std::tgamma(c + 1.L) / std::tgamma(degree + 3.L);
      worst = std::max(worst, std::abs(mean / exact - 1));
    }
  return static_cast<double>(worst);
}

class DunavantRule : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Degree, DunavantRule, testing::Range(1, 21));

TEST_P(DunavantRule, IntegratesItsDegreeAndNoMore) {
  const TriangleRule& rule = dunavant_rule(GetParam());
  EXPECT_EQ(rule.degree, GetParam() == 3 ? 4 : GetParam());
  expect_exactness(rule);
  // As L1 + L2 + L3 = 1, monomials of this degree span those below.
  EXPECT_LT(relative_monomial_error(rule, rule.degree), 1.1e-16 * (rule.degree + 4));
  EXPECT_GT(relative_monomial_error(rule, rule.degree + 1), 1e-7);
}

TEST_P(DunavantRule, HasPositiveWeightsAndPointsInside) {
  const TriangleRule& rule = dunavant_rule(GetParam());
  EXPECT_GT(rule.weights.minCoeff(), 0);
  EXPECT_GT(rule.points.minCoeff(), 0);
}

TEST_P(DunavantRule, HasTheSymmetriesOfTheTriangle) {
  const TriangleRule& rule = dunavant_rule(GetParam());
  for (Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::Vector3d p = rule.points.col(q);
    for (const Eigen::Vector3d& image :
         {Eigen::Vector3d(p[1], p[2], p[0]), Eigen::Vector3d(p[1], p[0], p[2])}) {
      Index twin;
      EXPECT_LT((rule.points.colwise() - image).colwise().norm().minCoeff(&twin), 1e-15);
      EXPECT_EQ(rule.weights[twin], rule.weights[q]);
    }
  }
}

TEST(DunavantRules, HaveFewPoints) {
  const int n_points[] = {1, 3, 6, 6, 7, 12, 15, 16, 19, 25, 28, 33, 37, 42, 49, 55, 60, 67, 73, 79};
  for (int degree = 1; degree <= 20; ++degree)
    EXPECT_EQ(dunavant_rule(degree).weights.size(), n_points[degree - 1]);
  EXPECT_THROW(dunavant_rule(0), Error);
  EXPECT_THROW(dunavant_rule(21), Error);
}

struct CollapsedCase {
  int across, along, grading, degree;
};

class CollapsedGaussRule : public testing::TestWithParam<CollapsedCase> {};
INSTANTIATE_TEST_SUITE_P(Sizes, CollapsedGaussRule,
                         testing::Values(CollapsedCase{1, 1, 1, 0}, CollapsedCase{2, 2, 1, 2},
                                         CollapsedCase{3, 8, 1, 4}, CollapsedCase{8, 3, 1, 4},
                                         CollapsedCase{8, 8, 1, 14}, CollapsedCase{16, 16, 1, 30},
                                         CollapsedCase{20, 20, 1, 38}, CollapsedCase{12, 4, 3, 6},
                                         CollapsedCase{3, 3, 3, 0}, CollapsedCase{16, 16, 3, 8},
                                         CollapsedCase{9, 9, 2, 7}));

TEST_P(CollapsedGaussRule, IntegratesTheDegreeItStates) {
  const auto [across, along, grading, degree] = GetParam();
  const TriangleRule rule = collapsed_gauss_rule(across, along, grading);
  EXPECT_EQ(rule.weights.size(), across * along);
  EXPECT_EQ(rule.degree, degree);
  expect_exactness(rule);
}

TEST_P(CollapsedGaussRule, HasPositiveWeightsAndPointsInside) {
  const auto [across, along, grading, degree] = GetParam();
  const TriangleRule rule = collapsed_gauss_rule(across, along, grading);
  EXPECT_GT(rule.weights.minCoeff(), 0);
  EXPECT_GT(rule.points.minCoeff(), 0);
}

TEST(CollapsedGaussRules, GradingClustersThePointsAtTheSide) {
  double nearest_plain = collapsed_gauss_rule(8, 8, 1).points.row(0).minCoeff();
  EXPECT_LT(collapsed_gauss_rule(8, 8, 3).points.row(0).minCoeff(), nearest_plain / 100);
}

TEST(CollapsedGaussRules, RefuseSizesThatIntegrateNothing) {
  EXPECT_THROW(collapsed_gauss_rule(0, 4), Error);
  EXPECT_THROW(collapsed_gauss_rule(4, 0), Error);
  EXPECT_THROW(collapsed_gauss_rule(2, 4, 3), Error);
  EXPECT_THROW(collapsed_gauss_rule(2, 4, 0), Error);
}

}  // namespace
