#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/outline_cleaning.hpp>
#include <polyfem/geometry/validity.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/random_polygon.hpp>
#include <tests/support/random_simple_polygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace polyfem;

/// `n` vertices put on each edge of a polygon, moved sideways at random by up to `noise`.
Points with_middles(const Points& polygon, int n, double noise, std::mt19937& random) {
  Points result(2, polygon.cols() * (n + 1));
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 from = polygon.col(k), along = polygon.col((k + 1) % polygon.cols()) - from;
    for (int i = 0; i <= n; ++i)
      result.col(k * (n + 1) + i) =
          from + i / (n + 1.0) * along +
          (i > 0 ? support::uniform(-noise, noise, random) : 0.0) * Vec2(along.y(), -along.x());
  }
  return result;
}

void expect_sources(const CleanedOutline& cleaned, Index n_before) {
  std::vector<int> all;
  ASSERT_EQ(cleaned.polygon.cols(), static_cast<Index>(cleaned.sources.size()));
  for (const std::vector<int>& sources : cleaned.sources) {
    EXPECT_FALSE(sources.empty());
    EXPECT_TRUE(std::is_sorted(sources.begin(), sources.end()));
    all.insert(all.end(), sources.begin(), sources.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end()) << "a vertex goes to one at most";
  EXPECT_EQ(cleaned.n_removed, n_before - cleaned.polygon.cols());
}

TEST(StraightVertices, AreDroppedAndTheOthersStayWhereTheyAre) {
  std::mt19937 random(1);
  for (int n = 3; n < 12; ++n) {
    const Points polygon = support::random_convex_polygon(n, random);
    const Points full = with_middles(polygon, 3, 1e-12, random);
    const CleanedOutline cleaned = drop_straight_vertices(full, 1e-9);
    EXPECT_EQ(cleaned.polygon, polygon);
    for (int k = 0; k < n; ++k) EXPECT_EQ(cleaned.sources[k], std::vector<int>{4 * k});
    expect_sources(cleaned, full.cols());
    EXPECT_EQ(drop_straight_vertices(polygon, 1e-9).n_removed, 0);
  }
}

TEST(StraightVertices, AreThoseExactlyOnTheLineForNoTurn) {
  const Points polygon = support::points({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2 + 1e-15}, {0, 2}});
  EXPECT_EQ(drop_straight_vertices(polygon, 0).sources,
            (std::vector<std::vector<int>>{{0}, {2}, {3}, {4}, {5}}));
  EXPECT_EQ(drop_straight_vertices(polygon, 1e-9).sources,
            (std::vector<std::vector<int>>{{0}, {2}, {3}, {5}}));
}

TEST(StraightVertices, OfConcaveShapesAreDroppedWithoutChangingTheArea) {
  for (const auto& [name, polygon] : support::concave_polygons()) {
    const CleanedOutline cleaned = drop_straight_vertices(polygon, 0);
    EXPECT_EQ(signed_area(cleaned.polygon), signed_area(polygon)) << name;
    EXPECT_FALSE(find_defect(cleaned.polygon));
    expect_sources(cleaned, polygon.cols());
  }
}

TEST(StraightVertices, OfACircleStayWhereItWouldLoseItsShape) {
  const Points circle = support::regular_polygon(1000);
  const CleanedOutline cleaned = drop_straight_vertices(circle, 0.05);
  EXPECT_GT(cleaned.polygon.cols(), 60) << "each turns by 0.1 at most then";
  EXPECT_LT(cleaned.polygon.cols(), 200);
  EXPECT_GT(signed_area(cleaned.polygon), 0.995 * signed_area(circle));
  EXPECT_EQ(drop_straight_vertices(circle, 1e-3).n_removed, 0);
}

TEST(StraightVertices, OfASliverAreKeptWhileItNeedsThem) {
  // Without its middle vertices nothing would be left.
  const Points lens = support::points({{0, 0}, {1, -1e-12}, {2, 0}, {1, 1e-12}});
  const CleanedOutline cleaned = drop_straight_vertices(lens, 1e-9);
  EXPECT_EQ(cleaned.polygon.cols(), 3);
  EXPECT_GT(signed_area(cleaned.polygon), 0);
}

TEST(ShortEdges, BecomeAVertexInTheirMiddle) {
  const Points polygon = support::points({{0, 0}, {2, 0}, {2, 0.01}, {2, 2}, {0, 2}});
  const CleanedOutline cleaned = merge_ends_of_short_edges(polygon, 0.1);
  EXPECT_EQ(cleaned.polygon, support::points({{0, 0}, {2, 0.005}, {2, 2}, {0, 2}}));
  EXPECT_EQ(cleaned.sources, (std::vector<std::vector<int>>{{0}, {1, 2}, {3}, {4}}));
  expect_sources(cleaned, 5);
  EXPECT_EQ(merge_ends_of_short_edges(polygon, 0.01).n_removed, 0) << "shorter, not as short as";
}

TEST(ShortEdges, AcrossTheFirstVertexGoToo) {
  const Points polygon = support::points({{0, 0.01}, {0, 0}, {2, 0}, {2, 2}, {0, 2}});
  const Points turned = support::points({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0.01}});
  EXPECT_EQ(merge_ends_of_short_edges(polygon, 0.1).polygon,
            support::points({{0, 0.005}, {2, 0}, {2, 2}, {0, 2}}));
  const CleanedOutline cleaned = merge_ends_of_short_edges(turned, 0.1);
  EXPECT_EQ(cleaned.polygon.cols(), 4);
  EXPECT_EQ(std::count(cleaned.sources.begin(), cleaned.sources.end(), std::vector<int>({0, 4})), 1);
  expect_sources(cleaned, 5);
}

TEST(ShortEdges, AreGoneAndThePolygonIsSimple) {
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    // A star whose corners are cut off by tiny edges, several to a corner.
    const int n = 4 + i % 9;
    Points polygon(2, 3 * n);
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      const Vec2 corner = support::uniform(0.3, 1, random) * Vec2(std::cos(angle), std::sin(angle));
      for (int j = 0; j < 3; ++j)
        polygon.col(3 * k + j) = corner + (j - 1) * 1e-3 * Vec2(-std::sin(angle), std::cos(angle)) +
                                 support::uniform(0, 1e-4, random) * Vec2(std::cos(angle), std::sin(angle));
    }
    ASSERT_FALSE(find_defect(polygon));
    const CleanedOutline cleaned = merge_ends_of_short_edges(polygon, 0.01);
    EXPECT_EQ(cleaned.polygon.cols(), n);
    EXPECT_FALSE(find_defect(cleaned.polygon));
    EXPECT_GT(signed_area(cleaned.polygon), 0);
    EXPECT_NEAR(signed_area(cleaned.polygon), signed_area(polygon), 2e-3 * n);
    expect_sources(cleaned, polygon.cols());
  }
}

TEST(CleanedOutlines, StaySimpleWhateverIsAskedFor) {
  std::mt19937 random(17);
  for (int i = 0; i < 400; ++i)
    for (const Points& polygon :
         {support::random_star(4 + i % 20, random), support::random_simple_polygon(4 + i % 20, random)})
      for (const double limit : {0.1, 0.5, 0.9})
        for (const CleanedOutline& cleaned :
             {drop_straight_vertices(polygon, limit), merge_ends_of_short_edges(polygon, limit)}) {
          EXPECT_FALSE(find_defect(cleaned.polygon));
          EXPECT_GT(signed_area(cleaned.polygon), 0);
          expect_sources(cleaned, polygon.cols());
        }
}

TEST(ShortEdges, StayWhereThePolygonWouldTouchItself) {
  // A thin wall: the short edge at its end cannot go without the two sides meeting.
  const Points triangle = support::points({{0, 0}, {1, 0}, {0, 1e-3}});
  EXPECT_EQ(merge_ends_of_short_edges(triangle, 0.1).polygon, triangle);
  for (const auto& [name, polygon] : support::concave_polygons()) {
    const CleanedOutline cleaned = merge_ends_of_short_edges(polygon, 10);
    EXPECT_FALSE(find_defect(cleaned.polygon)) << name;
    EXPECT_GT(signed_area(cleaned.polygon), 0) << name;
    EXPECT_GE(cleaned.polygon.cols(), 3) << name;
    expect_sources(cleaned, polygon.cols());
  }
}

}  // namespace
