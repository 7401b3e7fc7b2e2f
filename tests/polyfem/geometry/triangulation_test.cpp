#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/geometry/validity.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/random_simple_polygon.hpp>

#include <gtest/gtest.h>

#include <map>
#include <numeric>

using namespace polyfem;
using support::random_star;

namespace {

/// A saw blade on which many vertices are straight: every edge cut into three on a grid of powers of two.
Points with_straight_corners(const Points& polygon) {
  const Index n = polygon.cols();
  Points finer(2, 4 * n);
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < 4; ++j)
      finer.col(4 * k + j) = ((4. - j) * polygon.col(k) + double(j) * polygon.col((k + 1) % n)) / 4;
  return finer;
}

Points on_grid(const Points& polygon) {
  return (polygon * 1024).array().round().matrix() / 1024;
}

void expect_triangulation(const Points& polygon, const std::string& what) {
  ASSERT_FALSE(find_defect(polygon)) << what;
  const Triangles triangles = triangulate(polygon);
  ASSERT_EQ(triangles.cols(), polygon.cols() - 2) << what;
  double area = 0;
  std::map<std::pair<int, int>, int> uses;  // directed edges
  for (const auto& t : triangles.colwise()) {
    const Vec2 a = polygon.col(t[0]), b = polygon.col(t[1]), c = polygon.col(t[2]);
    EXPECT_EQ(orientation(a, b, c), 1) << what;
    area += cross(b - a, c - a) / 2;
    for (int k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  }
  EXPECT_NEAR(area, signed_area(polygon), 1e-13 * area) << what;
  // Every edge of the polygon is used once, every diagonal once in each direction: the triangles fit.
  const int n = static_cast<int>(polygon.cols());
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1) << what;
    const bool outer = (edge.first + 1) % n == edge.second;
    EXPECT_EQ(uses.count({edge.second, edge.first}), outer ? 0u : 1u) << what;
  }
}

TEST(Triangulation, FillsConcavePolygonsWithTrianglesThatHaveAnArea) {
  for (const auto& [name, polygon] : support::concave_polygons())
    for (Index first = 0; first < polygon.cols(); ++first) {  // whichever vertex is the first
      Points turned(2, polygon.cols());
      for (Index k = 0; k < polygon.cols(); ++k) turned.col(k) = polygon.col((first + k) % polygon.cols());
      expect_triangulation(turned, name);
    }
}

class TriangulationOfRandomPolygons : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Vertices, TriangulationOfRandomPolygons, testing::Values(3, 4, 5, 7, 12, 40));

TEST_P(TriangulationOfRandomPolygons, HasNoTriangleWithoutArea) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 10; ++trial) {
    const Points star = on_grid(random_star(GetParam(), random));
    if (find_defect(star) || signed_area(star) <= 0) continue;
    expect_triangulation(star, "star");
    expect_triangulation(with_straight_corners(star), "star with straight corners");
    expect_triangulation(support::random_convex_polygon(GetParam(), random), "convex");
  }
}

TEST(Triangulation, PrefersWellShapedEars) {
  // Cutting at the flat corner first would leave slivers.
  const Triangles triangles = triangulate(support::points({{0, 0}, {2, -0.1}, {4, 0}, {2, 2}}));
  for (const auto& t : triangles.colwise()) EXPECT_EQ((t.array() == 1).count() + (t.array() == 3).count(), 2);
}

TEST(Triangulation, RefusesPolygonsWithoutEars) {
  EXPECT_THROW(triangulate(support::points({{0, 0}, {0, 1}, {1, 1}, {1, 0}})), Error);  // clockwise
}

TEST(Triangulation, RefusesPolygonsWithoutArea) {
  for (const Index n : {0, 1, 2}) EXPECT_THROW(triangulate(Points::Zero(2, n)), Error) << n;
}

}  // namespace
