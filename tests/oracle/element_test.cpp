// The paper says that the element degenerates to the classical ones for n = 3 and n = 4. It does for
// triangles and for quadrilaterals with a pair of parallel sides, and for no others: Wachspress functions are
// rational, the bilinear functions of a general quadrilateral contain a square root of the position.
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/oracle/difference.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;
using oracle::Difference;

namespace {

/// K and M by a rule of ours.
std::array<double, 2> matrix_differences(const Points& polygon, const oracle::Element& theirs,
                                         const TriangleRule& rule, GradientCorrection correction) {
  TabulatedElement element;
  MatrixXd K, M;
  tabulate(polygon, rule, wachspress, correction, element);
  stiffness(element, elasticity_matrix(oracle::young, oracle::poisson, Plane::strain), K);
  mass(element, M);
  return {(K - theirs.stiffness).norm() / theirs.stiffness.norm(),
          (M - theirs.mass).norm() / theirs.mass.norm()};
}

/// Of any size and place, sides at an angle of at least 0.2 to the parallel ones, which differ in length by
/// up to a factor of 5.
Points random_trapezoid(std::mt19937& random) {
  const bool parallelogram = random() % 4 == 0;
  const double bottom = 1, top = parallelogram ? bottom : support::uniform(0.2, 1, random);
  const double height = support::uniform(0.2, 2, random);
  const double shift = support::uniform(-1, 2 - top, random) * std::min(1.0, 2 * height);
  Points polygon(2, 4);
  polygon << 0, bottom, shift + top, shift,  //
      0, 0, height, height;
  const Vec2 axis = support::random_direction(random);
  Mat2 R;
  R << axis.x(), -axis.y(), axis.y(), axis.x();
  polygon = (std::pow(10, support::uniform(-3, 3, random)) * R * polygon).eval();
  return polygon;
}

std::vector<Points> random_polygons(int n, Points (*draw)(std::mt19937&)) {
  std::mt19937 random(2);
  std::vector<Points> polygons;
  for (int k = 0; k < n; ++k) polygons.push_back(draw(random));
  return polygons;
}

Difference largest(const std::vector<Difference>& differences) {
  Difference worst;
  for (const Difference& difference : differences) worst = Difference::larger(worst, difference);
  return worst;
}

TEST(DealIIElement, LinearTriangleIsTheElementOfThreeVerticesWithAnyRule) {
  const auto triangles =
      random_polygons(50, [](std::mt19937& random) { return support::random_convex_polygon(3, random); });
  const auto theirs = oracle::deal_ii_elements(triangles, oracle::young, oracle::poisson, 0);
  for (std::size_t k = 0; k < triangles.size(); ++k)
    for (const GradientCorrection correction : {GradientCorrection::off, GradientCorrection::on})
      for (int degree = 2; degree <= 5; ++degree)  // the mass needs degree 2
        for (const double difference :
             matrix_differences(triangles[k], theirs[k], hammer_rule(degree), correction))
          EXPECT_LT(difference, 1e-13);
}

TEST(DealIIElement, BilinearOneIsOursPointByPointOnTenThousandTrapezoids) {
  const Difference worst = largest(oracle::differences(random_polygons(10000, random_trapezoid), 4));
  EXPECT_LT(worst.values, 1e-12);
  EXPECT_LT(worst.gradients, 1e-12);
  EXPECT_LT(worst.stiffness, 1e-12);
  EXPECT_LT(worst.mass, 1e-12);
}

TEST(DealIIElement, BilinearOneIsOursOnTrapezoidsWithFineRulesOfOnesOwn) {
  const auto trapezoids = random_polygons(30, random_trapezoid);
  const TriangleRule rule = collapsed_gauss_rule(24, 24);
  const auto theirs = oracle::deal_ii_elements(trapezoids, oracle::young, oracle::poisson, 20);
  for (std::size_t k = 0; k < trapezoids.size(); ++k)
    for (const double difference :
         matrix_differences(trapezoids[k], theirs[k], rule, GradientCorrection::off))
      EXPECT_LT(difference, 1e-12);
}

TEST(DealIIElement, BilinearOneOfAKiteIsAnother) {
  Points kite(2, 4);
  kite << 0, 1, 0, -1,  //
      -1, 0, 2, 0;
  const Difference difference = largest(oracle::differences({kite}, 20));
  EXPECT_NEAR(difference.values, 1.0e-2, 1e-3);
  EXPECT_NEAR(difference.stiffness, 1.8e-2, 1e-3);
  EXPECT_GT(difference.gradients, 1e-3);
  EXPECT_GT(difference.mass, 1e-3);
}

TEST(DealIIElement, QuadraticOneWithoutItsMiddleIsOursOnParallelograms) {
  std::vector<Points> parallelograms;
  std::mt19937 random(4);
  for (int k = 0; k < 100; ++k) {
    Points polygon(2, 4);
    polygon.col(0) << 0.3, -2;
    const Vec2 side(support::uniform(0.5, 2, random), support::uniform(-0.3, 0.3, random)),
        other(support::uniform(-0.5, 0.5, random), support::uniform(0.5, 2, random));
    polygon.col(1) = polygon.col(0) + side;
    polygon.col(2) = polygon.col(1) + other;
    polygon.col(3) = polygon.col(0) + other;
    parallelograms.push_back(polygon);
  }
  const auto theirs = oracle::deal_ii_serendipity_stiffness(parallelograms, oracle::young, oracle::poisson);
  const Mat3 D = elasticity_matrix(oracle::young, oracle::poisson, Plane::strain);
  PolygonRule rule;
  TabulatedElement element;
  MatrixXd K;
  for (std::size_t k = 0; k < parallelograms.size(); ++k)
    for (const GradientCorrection correction : {GradientCorrection::off, GradientCorrection::on}) {
      const Points& corners = parallelograms[k];
      Points nodes(2, 8);
      for (Index i = 0; i < 4; ++i) {
        nodes.col(2 * i) = corners.col(i);
        nodes.col(2 * i + 1) = (corners.col(i) + corners.col((i + 1) % 4)) / 2;
      }
      make_quadrilateral_rule(corners, 3, rule);
      tabulate_quadratic(nodes, rule, wachspress, correction, element);
      stiffness(element, D, K);
      EXPECT_LT((K - theirs[k]).norm(), 1e-12 * theirs[k].norm());
    }
}

}  // namespace
