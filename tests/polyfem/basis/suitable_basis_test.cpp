#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/testing/sample_polygons.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

TEST(SuitableBasis, IsWachspressWhereEveryCornerTurns) {
  for (const SamplePolygon& sample : sample_polygons(SampleShapes::strictly_convex, 100))
    EXPECT_EQ(suitable_basis(sample.vertices).name(), "wachspress") << sample.name;
}

TEST(SuitableBasis, IsMeanValueForConcaveCornersAndVerticesOnEdges) {
  for (const SamplePolygon& sample : concave_samples())
    EXPECT_EQ(suitable_basis(sample.vertices).name(), "mean_value") << sample.name;
  SampleRandom random(1);
  for (const int n : {3, 4, 8, 20})
    EXPECT_EQ(suitable_basis(with_middle_vertices(convex_sample(n, random))).name(), "mean_value");
}

TEST(SuitableBasis, ChangesWhereACornerTurnsByAThousandth) {
  for (const double turn : {-1e-2, 0., 1e-9, 0.9e-3, 1.1e-3, 1e-2}) {
    Points polygon(2, 5);
    polygon << 0, 0.5, 1, 1, 0,  //
        0, -turn / 4, 0, 1, 1;
    EXPECT_EQ(suitable_basis(polygon).name(), turn > 1e-3 ? "wachspress" : "mean_value") << turn;
  }
}

TEST(SuitableBasis, HasNoObjection) {
  for (const SamplePolygon& sample : sample_polygons(SampleShapes::simple, 100))
    EXPECT_NO_THROW(require_suitable(suitable_basis(sample.vertices), sample.vertices)) << sample.name;
}

}  // namespace
