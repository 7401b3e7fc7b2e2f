#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/definiteness.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/geometry/corner_turn.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/testing/sample_polygons.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

double least_turn(const Points& polygon) {
  return polyfem::least_turn(static_cast<int>(polygon.cols()), [&](int k) -> Vec2 { return polygon.col(k); });
}

/// The unit square with a fifth vertex at the middle of its lower edge, where the outline turns by `turn`.
Points square_turning_by(double turn) {
  Points polygon(2, 5);
  polygon << 0, 0.5, 1, 1, 0,  //
      0, -turn / 4, 0, 1, 1;
  return polygon;
}

MatrixXd stiffness_of(const TabulatedElement& element) {
  MatrixXd K;
  stiffness(element, elasticity_matrix(1, 0.3, Plane::strain), K);
  return K;
}

MatrixXd exact_stiffness(const Points& polygon, const Basis& basis) {
  TabulatedElement element;
  EXPECT_TRUE(tabulate_to_tolerance(polygon, basis, 1e-6, GradientCorrection::on, element).met);
  return stiffness_of(element);
}

TEST(SuitableBasis, IsWachspressWhereEveryCornerTurnsEnough) {
  int n_wachspress = 0;
  for (const SamplePolygon& sample : sample_polygons(SampleShapes::strictly_convex, 100)) {
    const bool turns = least_turn(sample.vertices) > least_wachspress_turn;
    EXPECT_EQ(suitable_basis(sample.vertices).name(), turns ? "wachspress" : "mean_value") << sample.name;
    n_wachspress += turns;
  }
  EXPECT_GT(n_wachspress, 5);
}

TEST(SuitableBasis, IsMeanValueForConcaveCornersAndVerticesOnEdges) {
  for (const SamplePolygon& sample : concave_samples())
    EXPECT_EQ(suitable_basis(sample.vertices).name(), "mean_value") << sample.name;
  SampleRandom random(1);
  for (const int n : {3, 4, 8, 20})
    EXPECT_EQ(suitable_basis(with_middle_vertices(convex_sample(n, random))).name(), "mean_value");
}

TEST(SuitableBasis, ChangesWhereACornerTurnsByAFifth) {
  for (const double turn : {-1e-2, 0., 1e-9, 2e-3, 0.19, 0.21, 0.5})
    EXPECT_EQ(suitable_basis(square_turning_by(turn)).name(), turn > 0.2 ? "wachspress" : "mean_value")
        << turn;
}

/// What the choice is for: with rules of fixed points no deformation loses half of its energy, whichever way
/// a corner turns.
TEST(SuitableBasis, IsSeenByRulesOfSixAndSevenPointsATriangle) {
  TabulatedElement element;
  const auto expect_seen = [&](const Points& polygon) {
    const Basis& basis = suitable_basis(polygon);
    const MatrixXd exact = exact_stiffness(polygon, basis);
    for (const int degree : {4, 5}) {
      tabulate(polygon, dunavant_rule(degree), basis, GradientCorrection::on, element);
      const EnergyRange energy = compare_energies(stiffness_of(element), exact);
      EXPECT_GT(energy.least, 0.5);
      EXPECT_LT(energy.largest, 2);
    }
  };
  for (const double turn : {-0.5, -0.1, -2e-3, 0., 1e-9, 2e-3, 0.02, 0.1, 0.19, 0.21, 0.3, 0.5}) {
    SCOPED_TRACE(turn);
    expect_seen(square_turning_by(turn));
  }
  for (const SamplePolygon& sample : sample_polygons(SampleShapes::convex, 8)) {
    SCOPED_TRACE(sample.name);
    expect_seen(sample.vertices);
  }
}

/// Shape functions of less energy approximate better, and mean value functions have about the least.
TEST(SuitableBasis, HasLittleMoreEnergyThanMeanValueFunctions) {
  for (const double turn : {-2e-3, 0., 2e-3, 0.1, 0.21, 0.3, 0.5}) {
    const Points polygon = square_turning_by(turn);
    EXPECT_LT(compare_energies(exact_stiffness(polygon, suitable_basis(polygon)),
                               exact_stiffness(polygon, mean_value))
                  .largest,
              4)
        << turn;
  }
}

TEST(SuitableBasis, HasNoRejection) {
  for (const SamplePolygon& sample : sample_polygons(SampleShapes::simple, 100))
    EXPECT_NO_THROW(require_suitable(suitable_basis(sample.vertices), sample.vertices)) << sample.name;
}

}  // namespace
