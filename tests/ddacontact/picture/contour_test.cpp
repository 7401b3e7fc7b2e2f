// Regions above a level: areas in closed form, nesting, holes; and the triangles they are cut from.

#include "../../support/random_polygon.hpp"
#include "frames.hpp"

#include <ddacontact/picture/contour.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <numbers>
#include <random>
#include <set>

namespace {

using namespace support;

double area_of(const Region& region) {
  double sum = 0;
  for (const auto& polygon : region) sum += area(polygon);
  return sum;
}

/// The area of a convex polygon where direction . x >= level.
double clipped_area(const Points& polygon, const Vec2& direction, double level) {
  std::vector<Vec2> kept;
  for (Index i = 0; i < polygon.cols(); ++i) {
    const Vec2 a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
    const double fa = direction.dot(a) - level, fb = direction.dot(b) - level;
    if (fa >= 0) kept.push_back(a);
    if ((fa >= 0) != (fb >= 0)) kept.push_back(a + fa / (fa - fb) * (b - a));
  }
  return kept.size() < 3 ? 0 : area(kept);
}

struct Drawn {
  Points outline;
  FanMesh mesh;
  Points nodes;
  Drawn(const Points& polygon, int rings)
      : outline(polygon),
        mesh(static_cast<int>(polygon.cols()), rings),
        nodes(mesh.nodes(polygon, polyfem::area_moments(polygon).centroid)) {}
};

class Polygons : public testing::TestWithParam<int> {
 protected:
  Points polygon() const {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    return random_convex_polygon(3 + GetParam(), random);
  }
};

TEST_P(Polygons, TrianglesTileThePolygonWithoutOverlap) {
  const Drawn drawn(polygon(), 5);
  double sum = 0;
  std::set<int> used;
  drawn.mesh.for_each_triangle([&](int a, int b, int c) {
    const double part = area({drawn.nodes.col(a), drawn.nodes.col(b), drawn.nodes.col(c)});
    EXPECT_GT(part, 0);
    sum += part;
    used.insert({a, b, c});
  });
  EXPECT_NEAR(sum, polyfem::signed_area(drawn.outline), 1e-12 * sum);
  EXPECT_EQ(static_cast<Index>(used.size()), drawn.nodes.cols());
}

TEST_P(Polygons, AreasAboveLevelsOfALinearFieldAreThoseOfTheClippedPolygon) {
  const Drawn drawn(polygon(), 4);
  const Vec2 direction(0.6, -1.7);
  const VectorXd values = direction.transpose() * drawn.nodes;
  std::vector<double> levels;
  for (int k = -2; k <= 12; ++k)
    levels.push_back(values.minCoeff() + k / 10.7 * (values.maxCoeff() - values.minCoeff()));
  const std::vector<Region> regions = superlevel_regions(drawn.mesh, drawn.nodes, values, levels);
  const double whole = polyfem::signed_area(drawn.outline);
  for (std::size_t k = 0; k < levels.size(); ++k)
    EXPECT_NEAR(area_of(regions[k]), clipped_area(drawn.outline, direction, levels[k]), 1e-12 * whole) << k;
  EXPECT_TRUE(regions.back().empty());
}

TEST_P(Polygons, ARegionOfTheWholeBlockIsItsOutline) {
  const Drawn drawn(polygon(), 6);
  const VectorXd values = VectorXd::Constant(drawn.nodes.cols(), 3.);
  const Region region = superlevel_regions(drawn.mesh, drawn.nodes, values, {3.}).front();
  ASSERT_EQ(region.size(), 1u);
  EXPECT_EQ(static_cast<Index>(region[0].size()), drawn.outline.cols());  // no nodes between corners
  EXPECT_NEAR(area_of(region), polyfem::signed_area(drawn.outline), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Polygons, testing::Range(0, 8));

TEST(Contour, HolesAreTakenAwayAndTheirAreaConvergesAtSecondOrder) {
  const double radius = 0.3, disc = std::numbers::pi * radius * radius;
  std::vector<double> errors;
  for (const int rings : {16, 32, 64}) {
    const Drawn drawn(box(-0.5, -0.5, 1, 1), rings);
    const VectorXd values = drawn.nodes.colwise().norm();
    const Region region = superlevel_regions(drawn.mesh, drawn.nodes, values, {radius}).front();
    ASSERT_EQ(region.size(), 2u);  // the outline and the rim of the hole
    EXPECT_LT(area(region[0]) * area(region[1]), 0);
    errors.push_back(std::abs(area_of(region) - (1 - disc)));
  }
  EXPECT_LT(errors[1], errors[0] / 3);
  EXPECT_LT(errors[2], errors[1] / 3);
}

TEST(Contour, RegionsOfManyPeaksAreNested) {
  const Drawn drawn(box(0, 0, 1, 1), 40);
  VectorXd values(drawn.nodes.cols());
  for (Index i = 0; i < values.size(); ++i)
    values[i] = std::sin(9 * drawn.nodes(0, i)) * std::cos(7 * drawn.nodes(1, i));
  const std::vector<double> levels = {-0.9, -0.5, 0, 0.3, 0.6, 0.9};
  double before = 1;
  for (const Region& region : superlevel_regions(drawn.mesh, drawn.nodes, values, levels)) {
    const double now = area_of(region);
    EXPECT_GT(now, 0);
    EXPECT_LT(now, before);
    before = now;
  }
}

}  // namespace
