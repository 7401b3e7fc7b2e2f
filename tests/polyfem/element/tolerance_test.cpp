#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <polyfem/quadrature/graded_rule.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/direct_mean_value.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>

using namespace polyfem;

namespace {

constexpr auto on = GradientCorrection::on, off = GradientCorrection::off;
const support::DirectMeanValue direct_mean_value;

struct Matrices {
  MatrixXd K, M;
};

Matrices matrices_of(const TabulatedElement& element) {
  Matrices matrices;
  stiffness(element, elasticity_matrix(1, 0.3, Plane::strain), matrices.K);
  mass(element, matrices.M);
  return matrices;
}

ErrorEstimate true_error(const Matrices& matrices, const Matrices& exact) {
  return {(matrices.K - exact.K).norm() / exact.K.norm(), (matrices.M - exact.M).norm() / exact.M.norm()};
}

double larger(const ErrorEstimate& error) {
  return std::max(error.stiffness, error.mass);
}

/// Good to 1e-12 or so, see `ReferenceAgreesWithARuleOfAnotherKind`.
Matrices wachspress_reference(const Points& polygon) {
  PolygonRule rule;
  TabulatedElement element;
  make_adjoint_rule(polygon, 40, rule);
  tabulate(polygon, rule, wachspress, off, element);
  return matrices_of(element);
}

Matrices mean_value_reference(const Points& polygon) {
  PolygonRule rule;
  TabulatedElement element;
  make_vertex_rule(polygon, 30, rule);
  tabulate(polygon, rule, direct_mean_value, off, element);
  return matrices_of(element);
}

/// Random convex polygons of 3 .. 12 vertices and cells of random sites with all their short edges.
std::vector<Points> convex_cells() {
  std::vector<Points> cells;
  std::mt19937 random(11);
  for (int i = 0; i < 100; ++i) cells.push_back(support::random_convex_polygon(3 + i % 10, random));
  VoronoiOptions options;
  options.n_cells = 200;
  options.lloyd_steps = 0;
  options.smallest_edge = 0;
  const PolygonMesh mesh = voronoi(support::points({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), options);
  for (int c = 0; c < mesh.n_cells(); ++c) cells.push_back(mesh.outline(c));
  return cells;
}

TEST(TabulateToTolerance, ReferenceAgreesWithARuleOfAnotherKind) {
  std::mt19937 random(5);
  TabulatedElement element;
  for (const int n : {4, 5, 6}) {
    const Points polygon = support::random_convex_polygon(n, random);
    tabulate(polygon, collapsed_gauss_rule(40, 40, 2), wachspress, off, element);
    EXPECT_LT(larger(true_error(matrices_of(element), wachspress_reference(polygon))), 1e-12);
  }
}

TEST(TabulateToTolerance, MeetsItOnConvexCellsWithFewPoints) {
  const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10};
  const double most_points[] = {200, 300, 400, 550};  // the median
  std::vector<int> n_points[4];
  std::vector<double> overestimates;
  int n_late = 0;
  TabulatedElement element;
  for (const Points& polygon : convex_cells()) {
    const Matrices exact = wachspress_reference(polygon);
    for (int t = 0; t < 4; ++t) {
      const ToleranceReport report = tabulate_to_tolerance(polygon, wachspress, tolerances[t], on, element);
      EXPECT_TRUE(report.met);
      EXPECT_LE(larger(report.error), tolerances[t]);
      EXPECT_EQ(report.n_points, element.n_points());
      const double error = larger(true_error(matrices_of(element), exact));
      EXPECT_LE(error, 3 * tolerances[t]);
      if (error > tolerances[t]) ++n_late;
      n_points[t].push_back(report.n_points);
      if (polygon.cols() > 3) overestimates.push_back(larger(report.error) / (error + 1e-14));
    }
  }
  EXPECT_LE(n_late, 1);  // of 1200
  for (int t = 0; t < 4; ++t) {
    std::sort(n_points[t].begin(), n_points[t].end());
    EXPECT_LE(n_points[t][n_points[t].size() / 2], most_points[t]);
  }
  std::sort(overestimates.begin(), overestimates.end());
  EXPECT_GT(overestimates[overestimates.size() / 100], 1);      // a bound
  EXPECT_LT(overestimates[overestimates.size() * 9 / 10], 40);  // of use
}

TEST(TabulateToTolerance, MeetsItForABasisSingularAtVerticesOnConcavePolygons) {
  TabulatedElement element;
  for (const auto& [name, polygon] : support::concave_polygons()) {
    const Matrices exact = mean_value_reference(polygon);
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      const ToleranceReport report =
          tabulate_to_tolerance(polygon, direct_mean_value, tolerance, on, element);
      EXPECT_TRUE(report.met) << name;
      EXPECT_LT(larger(true_error(matrices_of(element), exact)), 2 * tolerance) << name;
      EXPECT_EQ(report.rule, "Gauss points collapsed at the vertices") << name;
    }
  }
}

TEST(TabulateToTolerance, SeesWhetherABasisIsSmoothAtVertices) {
  std::mt19937 random(2);
  TabulatedElement element;
  for (int n = 4; n <= 12; ++n) {
    const Points polygon = support::random_convex_polygon(n, random);
    EXPECT_EQ(tabulate_to_tolerance(polygon, wachspress, 1e-3, on, element).rule,
              "Gauss points graded by the adjoint");
    EXPECT_EQ(tabulate_to_tolerance(polygon, direct_mean_value, 1e-3, on, element).rule,
              "Gauss points collapsed at the vertices");
  }
}

TEST(TabulateToTolerance, TakesWachspressFunctionsForSmoothNextToAnAlmostStraightCorner) {
  TabulatedElement element;
  const Points polygon = support::points({{1, -1e-5}, {2, 0}, {2, 2}, {0, 2}, {0, 0}});
  EXPECT_EQ(tabulate_to_tolerance(polygon, wachspress, 1e-3, on, element).rule,
            "Gauss points graded by the adjoint");
}

TEST(TabulateToTolerance, TakesThreePointsOnTriangles) {
  std::mt19937 random(3);
  TabulatedElement element;
  const Points triangle = support::random_convex_polygon(3, random);
  const ToleranceReport report = tabulate_to_tolerance(triangle, wachspress, 1e-12, on, element);
  EXPECT_TRUE(report.met);
  EXPECT_EQ(report.n_points, 3);
}

TEST(TabulateToTolerance, SaysWhatWasReachedWhereRoundOffForbidsMore) {
  std::mt19937 random(4);
  TabulatedElement element;
  const Points polygon = support::random_convex_polygon(7, random);
  for (const double tolerance : {1e-17, 1e-300}) {
    const ToleranceReport report = tabulate_to_tolerance(polygon, wachspress, tolerance, on, element);
    EXPECT_FALSE(report.met);
    EXPECT_GT(larger(report.error), tolerance);
    EXPECT_LT(larger(report.error), 1e-11);
    EXPECT_LT(larger(true_error(matrices_of(element), wachspress_reference(polygon))), 1e-12);
  }
}

TEST(TabulateToTolerance, SaysWhatWasReachedWhereTooManyPointsAreNeeded) {
  TabulatedElement element;
  const ToleranceReport report =
      tabulate_to_tolerance(support::regular_polygon(100), direct_mean_value, 1e-12, on, element);
  EXPECT_FALSE(report.met);
  EXPECT_LE(report.n_points, 30000);
  EXPECT_LT(larger(report.error), 1e-2);
}

TEST(TabulateToTolerance, CostsNoMoreForSizeAndPlace) {
  std::mt19937 random(6);
  TabulatedElement element;
  const Points polygon = support::random_convex_polygon(6, random);
  const ToleranceReport report = tabulate_to_tolerance(polygon, wachspress, 1e-6, on, element);
  for (const double size : {1e-6, 1e6}) {
    const Points moved = (size * polygon).colwise() + Vec2(300 * size, -500 * size);
    EXPECT_EQ(tabulate_to_tolerance(moved, wachspress, 1e-6, on, element).n_points, report.n_points);
  }
}

TEST(TabulateToTolerance, RefusesToleranceAndBasisThatMakeNoSense) {
  TabulatedElement element;
  const Points square = support::regular_polygon(4);
  for (const double tolerance : {0., -1., 1., std::nan("")})
    EXPECT_THROW(tabulate_to_tolerance(square, wachspress, tolerance, on, element), Error);
  const Points dart = support::concave_polygons().front().points;
  EXPECT_THROW(tabulate_to_tolerance(dart, wachspress, 1e-6, on, element), Error);
}

TEST(TabulateToTolerance, IsFiniteForMeanValueFunctionsNextToAShortEdge) {
  TabulatedElement element;
  const Points polygon = support::points({{0, 0}, {1, 0}, {1, 1}, {1e-8, 1}, {0, 1 - 1e-8}});
  const ToleranceReport report = tabulate_to_tolerance(polygon, mean_value, 1e-6, on, element);
  EXPECT_TRUE(std::isfinite(larger(report.error)));
  EXPECT_TRUE(element.dx.allFinite());
}

TEST(TabulateToTolerance, SaysSoWhereExponentsDoNotSuffice) {
  TabulatedElement element;
  for (const double size : {1e-100, 1e100}) {
    const Points polygon = size * support::regular_polygon(6);
    for (const Basis* basis :
         {static_cast<const Basis*>(&wachspress), static_cast<const Basis*>(&mean_value)})
      EXPECT_FALSE(tabulate_to_tolerance(polygon, *basis, 1e-6, on, element).met);
  }
}

TEST(TabulateToTolerance, SeesThatMeanValueFunctionsAreSingularHoweverThinThePolygon) {
  TabulatedElement element;
  for (const double width : {1., 1e-3, 1e-6, 1e-9}) {
    Points hexagon = support::regular_polygon(6);
    hexagon.row(1) *= width;
    EXPECT_EQ(tabulate_to_tolerance(hexagon, mean_value, 1e-2, on, element).rule,
              "Gauss points collapsed at the vertices");
    EXPECT_EQ(tabulate_to_tolerance(hexagon, wachspress, 1e-2, on, element).rule,
              "Gauss points graded by the adjoint");
  }
}

TEST(TabulateToTolerance, MeetsItForMeanValueFunctionsNextToAnAlmostStraightCorner) {
  TabulatedElement element;
  const Points polygon = support::points({{0, 0}, {0.5, -1e-4}, {1, 0}, {1, 0.03}});
  EXPECT_TRUE(tabulate_to_tolerance(polygon, suitable_basis(polygon), 1e-3, on, element).met);
}

TEST(TabulateToTolerance, TakesWachspressFunctionsForSmoothNextToAShortEdge) {
  TabulatedElement element;
  for (const double length : {1e-3, 1e-6, 1e-9}) {
    const Points polygon = support::points({{0, 0}, {1, 0}, {1, 1}, {length, 1}, {0, 1 - length}});
    EXPECT_EQ(tabulate_to_tolerance(polygon, wachspress, 1e-2, on, element).rule,
              "Gauss points graded by the adjoint");
  }
}

TEST(TabulateToTolerance, KeepsTheLeastErrorWhereItIsNotMet) {
  PolygonRule rule;
  TabulatedElement element, trial;
  for (const auto& [name, polygon] : support::concave_polygons()) {
    const ToleranceReport report = tabulate_to_tolerance(polygon, mean_value, 1e-16, on, element);
    EXPECT_FALSE(report.met) << name;
    EXPECT_EQ(larger(report.error), larger(estimate_errors(polygon, mean_value, element))) << name;
    for (const double digits : {std::log(8 / 1e-16) / 1.15, 42.}) {  // those of the first trial and the last
      make_vertex_rule(polygon, digits, rule);
      tabulate(polygon, rule, mean_value, on, trial);
      EXPECT_LE(larger(report.error), larger(estimate_errors(polygon, mean_value, trial))) << name;
    }
  }
}

TEST(TabulateToTolerance, RefusesPolygonsThatAreNone) {
  TabulatedElement element;
  const double nan = std::nan("");
  Points pentagram(2, 5);
  for (Index k = 0; k < 5; ++k) pentagram.col(k) = support::regular_polygon(5).col(2 * k % 5);
  for (const Points& polygon :
       {Points(2, 0), support::points({{0, 0}, {1, 0}}), support::points({{0, 0}, {1, 0}, {nan, 1}, {0, 1}}),
        support::points({{0, 0}, {1, 0}, {2, 0}, {3, 0}}), support::points({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),
        support::points({{0, 1}, {1, 1}, {1, 0}, {0, 0}}), pentagram})
    for (const Basis* basis :
         {static_cast<const Basis*>(&wachspress), static_cast<const Basis*>(&mean_value)})
      EXPECT_THROW(tabulate_to_tolerance(polygon, *basis, 1e-6, on, element), Error);
}

/// The estimate serves any rule, corrected or not.
TEST(EstimateErrors, BoundsThoseOfTheUsualRulesToAFactor) {
  std::mt19937 random(8);
  TabulatedElement element;
  for (int n = 4; n <= 12; ++n)
    for (int trial = 0; trial < 5; ++trial) {
      const Points polygon = support::random_convex_polygon(n, random);
      const Matrices exact = wachspress_reference(polygon);
      for (const TriangleRule& rule :
           {hammer_rule(3), dunavant_rule(5), dunavant_rule(12), collapsed_gauss_rule(8, 4, 2)})
        for (const GradientCorrection correction : {on, off}) {
          tabulate(polygon, rule, wachspress, correction, element);
          const ErrorEstimate estimate = estimate_errors(polygon, wachspress, element);
          const ErrorEstimate error = true_error(matrices_of(element), exact);
          EXPECT_LT(error.stiffness, 5 * estimate.stiffness);
          EXPECT_LT(error.mass, 20 * estimate.mass);
        }
    }
}

TEST(EstimateErrors, DoesNotDependOnTheCorrection) {
  std::mt19937 random(9);
  TabulatedElement raw, corrected;
  const Points polygon = support::random_convex_polygon(6, random);
  tabulate(polygon, hammer_rule(4), wachspress, off, raw);
  tabulate(polygon, hammer_rule(4), wachspress, on, corrected);
  const ErrorEstimate a = estimate_errors(polygon, wachspress, raw),
                      b = estimate_errors(polygon, wachspress, corrected);
  EXPECT_NEAR(a.stiffness / b.stiffness, 1, 1e-10);
  EXPECT_NEAR(a.mass / b.mass, 1, 1e-10);
}

}  // namespace
