#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/element_report.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

ElementReport examine_with(const TriangleRule& rule, const Points& polygon) {
  TabulatedElement element;
  tabulate(polygon, rule, wachspress, GradientCorrection::on, element);
  return examine(polygon, wachspress, element, "some rule");
}

TEST(Examine, FindsASoundElementSound) {
  std::mt19937 random(1);
  const Points polygon = support::random_convex_polygon(6, random);
  const ElementReport report = examine_with(dunavant_rule(12), polygon);
  EXPECT_EQ(report.rule, "some rule");
  EXPECT_EQ(report.n_points, 6 * 33);
  EXPECT_TRUE(report.definite);
  EXPECT_EQ(report.zero_modes, 3);
  EXPECT_GT(report.condition, 1);
  EXPECT_GT(report.least_mass, 0);
  EXPECT_LT(report.error.mass, examine_with(dunavant_rule(2), polygon).error.mass);
}

TEST(Examine, CountsTheMechanismsOfAPoorRule) {
  PolygonRule rule{Points::Zero(2, 1), VectorXd::Constant(1, 2.)};  // the square's area at its centre
  TabulatedElement element;
  const Points square = support::regular_polygon(4);
  tabulate(square, rule, wachspress, GradientCorrection::on, element);
  const ElementReport report = examine(square, wachspress, element, "one point");
  EXPECT_EQ(report.zero_modes, 5);
  EXPECT_FALSE(report.definite);
}

/// The fifth vertex is 245 times as stiff as the rule has it, though K has full rank.
TEST(Examine, CallsAnElementUnsoundWhoseRuleDoesNotSeeItsFunctions) {
  const Points polygon = support::points({{0, 0}, {0.5, -5e-4}, {1, 0}, {1, 1}, {0, 1}});
  for (int degree = 2; degree <= 8; ++degree) {
    const ElementReport report = examine_with(dunavant_rule(degree), polygon);
    EXPECT_EQ(report.zero_modes, 3);
    EXPECT_LT(report.energy.least, 0.1);
    EXPECT_FALSE(report.definite);
    EXPECT_NE(describe(report).find("rank-deficient or indefinite"), std::string::npos);
  }
  TabulatedElement element;
  tabulate_to_tolerance(polygon, wachspress, 1e-3, GradientCorrection::on, element);
  EXPECT_TRUE(examine(polygon, wachspress, element, "").definite);
  tabulate(polygon, dunavant_rule(4), mean_value, GradientCorrection::on, element);
  EXPECT_TRUE(examine(polygon, mean_value, element, "").definite);
}

TEST(Examine, NamesTheStraightestCornerAndTheShortestEdge) {
  const Points polygon = support::points({{0, 0}, {4, -0.01}, {8, 0}, {8, 7}, {7.9, 8}, {0, 8}});
  const ElementReport report = examine_with(dunavant_rule(5), polygon);
  EXPECT_EQ(report.straightest_corner, 1);
  EXPECT_NEAR(report.least_turn, 0.005, 1e-5);
  EXPECT_EQ(report.shortest_edge_index, 3);
  EXPECT_NEAR(report.shortest_edge, std::hypot(0.1, 1) / 8, 1e-3);
}

TEST(Examine, DoesNotTakeASharpCornerForAStraightOne) {
  const ElementReport report = examine_with(hammer_rule(2), support::points({{0, 0}, {10, 0.1}, {0, 5}}));
  EXPECT_GT(report.least_turn, 0.4);
}

TEST(Describe, IsOneLineWithAllThatWasFound) {
  std::mt19937 random(1);
  const std::string text = describe(examine_with(hammer_rule(4), support::random_convex_polygon(5, random)));
  for (const char* part : {"some rule", "30 points", "of K", "of M", "full rank and positive definite",
                           "3 zero modes", "energies", "condition", "corner", "edge"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(Examine, NamesTheSharpestCorner) {
  const ElementReport needle = examine_with(hammer_rule(2), support::points({{1, 0}, {1, 1e-6}, {0, 0}}));
  EXPECT_EQ(needle.sharpest_corner, 2);
  EXPECT_NEAR(needle.least_angle / 1e-6, 1, 1e-9);
  EXPECT_NE(describe(needle).find("corner 2 has an angle of 1e-06"), std::string::npos);
}

TEST(Examine, DoesNotTakeAReflexCornerForASharpOne) {
  const Points dart = support::points({{0, 0}, {1, -2}, {0, 2}, {-1, -2}});
  TabulatedElement element;
  tabulate(dart, hammer_rule(2), mean_value, GradientCorrection::on, element);
  const ElementReport report = examine(dart, mean_value, element, "");
  EXPECT_NE(report.sharpest_corner, 0);
  EXPECT_NEAR(report.least_angle, std::atan(0.5) - std::atan(0.25), 1e-12);
}

}  // namespace
