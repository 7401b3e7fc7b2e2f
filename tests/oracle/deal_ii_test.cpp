// The paper says that the element degenerates to the classical ones for n = 3 and n = 4. It does for
// triangles and for quadrilaterals with a pair of parallel sides, and for no others: Wachspress functions are
// rational, the bilinear functions of a general quadrilateral contain a square root of the position.
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/oracle/deal_ii_element_matrices.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>

using namespace polyfem;

namespace {

constexpr double young = 1, poisson = 0.3;
constexpr unsigned n_gauss = 20;

oracle::ElementMatrices our_matrices(const Points& polygon, const TriangleRule& rule,
                                     GradientCorrection correction) {
  TabulatedElement element;
  tabulate(polygon, rule, wachspress, correction, element);
  oracle::ElementMatrices ours;
  stiffness(element, elasticity_matrix(young, poisson, Plane::strain), ours.stiffness);
  mass(element, ours.mass);
  return ours;
}

double relative_difference(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

struct Difference {
  double stiffness = 0, mass = 0;
};

/// With rules so fine on both sides that their errors do not show.
Difference difference_to_deal_ii(const Points& polygon) {
  static const TriangleRule rule = collapsed_gauss_rule(24, 24);
  const auto ours = our_matrices(polygon, rule, GradientCorrection::off);
  const auto theirs = oracle::deal_ii_element_matrices(polygon, young, poisson, n_gauss);
  return {relative_difference(ours.stiffness, theirs.stiffness), relative_difference(ours.mass, theirs.mass)};
}

Points rotated(const Points& polygon, double angle) {
  Mat2 R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R * polygon;
}

/// Lower side of length 2, upper one parallel to it; a parallelogram when they are of equal length.
Points random_trapezoid(bool parallelogram, std::mt19937& random) {
  const double top = parallelogram ? 2 : support::uniform(0.8, 3, random);
  const double height = support::uniform(0.7, 2, random), shift = support::uniform(-0.7, 0.7, random);
  Points polygon(2, 4);
  polygon << 0, 2, shift + top, shift,  //
      0, 0, height, height;
  return rotated(polygon, support::uniform(0, 6, random));
}

TEST(DealII, LinearTriangleIsTheElementOfThreeVerticesWithAnyRule) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Points triangle = support::random_convex_polygon(3, random);
    const auto theirs = oracle::deal_ii_element_matrices(triangle, young, poisson, n_gauss);
    for (const GradientCorrection correction : {GradientCorrection::off, GradientCorrection::on})
      for (int degree = 2; degree <= 5; ++degree) {  // the mass needs degree 2
        const auto ours = our_matrices(triangle, hammer_rule(degree), correction);
        EXPECT_LT(relative_difference(ours.stiffness, theirs.stiffness), 1e-13);
        EXPECT_LT(relative_difference(ours.mass, theirs.mass), 1e-13);
      }
  }
}

class DealIITrapezoid : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Shapes, DealIITrapezoid, testing::Bool(),
                         [](const auto& test) { return test.param ? "Parallelogram" : "Trapezoid"; });

TEST_P(DealIITrapezoid, BilinearElementIsTheElementOfFourVertices) {
  std::mt19937 random(2);
  Difference worst;
  for (int trial = 0; trial < 30; ++trial) {
    const Difference difference = difference_to_deal_ii(random_trapezoid(GetParam(), random));
    worst.stiffness = std::max(worst.stiffness, difference.stiffness);
    worst.mass = std::max(worst.mass, difference.mass);
  }
  EXPECT_LT(worst.stiffness, 1e-12);
  EXPECT_LT(worst.mass, 1e-12);
  RecordProperty("stiffness", testing::PrintToString(worst.stiffness));
  RecordProperty("mass", testing::PrintToString(worst.mass));
}

TEST(DealII, BilinearElementOfAKiteIsAnotherOne) {
  Points kite(2, 4);
  kite << 0, 1, 0, -1,  //
      -1, 0, 2, 0;
  const Difference difference = difference_to_deal_ii(kite);
  EXPECT_GT(difference.stiffness, 1e-3);
  EXPECT_GT(difference.mass, 1e-3);
  RecordProperty("stiffness", testing::PrintToString(difference.stiffness));
  RecordProperty("mass", testing::PrintToString(difference.mass));
}

TEST(DealII, DifferenceNearASquareGrowsWithTheSquareOfThePerturbation) {
  const auto difference = [](double perturbation) {
    Points polygon(2, 4);
    polygon << 0, 1, 1 + perturbation, 0,  //
        0, 0, 1 + perturbation, 1;         // a kite about the diagonal, a square without it
    return difference_to_deal_ii(polygon).stiffness;
  };
  const double ratio = difference(0.02) / difference(0.01);
  EXPECT_NEAR(ratio, 4, 0.2);
}

}  // namespace
