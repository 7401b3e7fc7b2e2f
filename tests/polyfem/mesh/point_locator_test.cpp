#include <polyfem/core/error.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/point_locator.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <random>

using namespace polyfem;

namespace {

/// The least distance from x to a cell, by looking at all of them with many points on their edges.
double least_distance(const PolygonMesh& mesh, const Vec2& x) {
  double least = 1e300;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points polygon = mesh.outline(c);
    if (contains(polygon, x)) return 0;
    for (Index k = 0; k < polygon.cols(); ++k)
      for (int i = 0; i <= 1000; ++i) {
        const double t = i / 1000.;
        least = std::min(least,
                         ((1 - t) * polygon.col(k) + t * polygon.col((k + 1) % polygon.cols()) - x).norm());
      }
  }
  return least;
}

TEST(PointLocator, FindsWhatALookAtAllCellsFinds) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-2, 4);
  for (const PolygonMesh& mesh :
       {voronoi(support::l_shape(), {.n_cells = 50}), chevrons({0, 0}, {2, 2}, 4, 5),
        rectangles({0, 0}, {2, 1e-3}, 50, 1), rectangles({0, 0}, {1, 1}, 1, 1)}) {
    const PointLocator locator(mesh);
    for (int k = 0; k < 60; ++k) {
      const Vec2 x(coordinate(random), coordinate(random));
      const Located there = locator.nearest(x);
      EXPECT_NEAR(there.distance, least_distance(mesh, x), 1e-5) << x.transpose();
      EXPECT_NEAR((there.point - x).norm(), there.distance, 1e-15);
      EXPECT_TRUE(contains(mesh.outline(there.cell), there.point) || there.distance > 0);
    }
  }
}

TEST(PointLocator, FindsVerticesAndFarPoints) {
  const PolygonMesh mesh = voronoi(support::l_shape(), {.n_cells = 50});
  const PointLocator locator(mesh);
  for (const auto vertex : mesh.vertices.colwise()) EXPECT_LT(locator.nearest(vertex).distance, 1e-15);
  const Located corner = locator.nearest({1e6, 1e6 + 0.5});  // sees the concave corner's neighbour first
  EXPECT_LT((corner.point - Vec2(2, 1)).norm() * (corner.point - Vec2(1, 2)).norm(), 1e-9);
  EXPECT_THROW(locator.nearest({std::nan(""), 0}), Error);
  const PolygonMesh empty;
  EXPECT_THROW(PointLocator{empty}, Error);
}

}  // namespace
