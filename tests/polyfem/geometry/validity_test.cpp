#include <polyfem/core/error.hpp>
#include <polyfem/geometry/validity.hpp>
#include <tests/support/domains.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace polyfem;
using support::polygon_of;

namespace {

struct DefectCase {
  const char* name;
  Points polygon;
  PolygonDefect defect;
  int vertex, other;
};

class FindDefect : public testing::TestWithParam<DefectCase> {};

const double infinity = std::numeric_limits<double>::infinity();
INSTANTIATE_TEST_SUITE_P(
    Polygons, FindDefect,
    testing::Values(
        DefectCase{"Segment", polygon_of({{0, 0}, {1, 0}}), PolygonDefect::too_few_vertices, 0, 0},
        DefectCase{"Infinite", polygon_of({{0, 0}, {1, 0}, {0, infinity}}), PolygonDefect::not_finite, 2, 2},
        DefectCase{"RepeatedNeighbour", polygon_of({{0, 0}, {1, 0}, {1, 0}, {0, 1}}),
                   PolygonDefect::repeated_vertex, 1, 2},
        DefectCase{"RepeatedAcross", polygon_of({{0, 0}, {1, 0}, {2, 1}, {1, 2}, {1, 0}, {0, 1}}),
                   PolygonDefect::repeated_vertex, 1, 4},
        DefectCase{"Collinear", polygon_of({{0, 0}, {1, 1}, {3, 3}, {2, 2}}), PolygonDefect::zero_area, 0, 0},
        DefectCase{"BowTie", polygon_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), PolygonDefect::self_intersection,
                   0, 2},
        DefectCase{"Spike", polygon_of({{0, 0}, {4, 0}, {4, 2}, {4, 1}, {0, 4}}),
                   PolygonDefect::self_intersection, 1, 3},
        DefectCase{"SpikeAtVertexZero", polygon_of({{0, 0}, {1, 0}, {1, 1}, {2, 0}}),
                   PolygonDefect::self_intersection, 1, 3},
        DefectCase{"VertexTouchesEdge", polygon_of({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}),
                   PolygonDefect::self_intersection, 0, 2}),
    [](const auto& test) { return test.param.name; });

TEST_P(FindDefect, NamesTheDefectAndItsPlace) {
  const auto found = find_defect(GetParam().polygon);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->defect, GetParam().defect);
  EXPECT_EQ(found->vertex, GetParam().vertex);
  EXPECT_EQ(found->other, GetParam().other);
}

TEST(FindDefectOfSoundPolygons, FindsNothingInEitherOrientation) {
  const Points concave = polygon_of({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  const Points vertex_on_edge = polygon_of({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}});
  EXPECT_FALSE(find_defect(concave));
  EXPECT_FALSE(find_defect(concave.rowwise().reverse()));
  EXPECT_FALSE(find_defect(vertex_on_edge));
  std::mt19937 random(1);
  for (int n = 3; n <= 60; ++n) {
    const Points polygon = support::random_convex_polygon(n, random);
    EXPECT_FALSE(find_defect(polygon));
    EXPECT_FALSE(find_defect(polygon.rowwise().reverse()));
    EXPECT_FALSE(find_non_convex_corner(polygon));
  }
}

TEST(FindNonConvexCorner, FindsConcaveAndStraightCornersToTheLastBit) {
  EXPECT_EQ(find_non_convex_corner(polygon_of({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})), 3);
  EXPECT_EQ(find_non_convex_corner(polygon_of({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}})), 1);
  const double below = -std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(find_non_convex_corner(polygon_of({{0, 0}, {1, -1e-300}, {2, 0}, {2, 1}, {0, 1}})), std::nullopt);
  EXPECT_EQ(find_non_convex_corner(polygon_of({{0, 0}, {1, -below * 1e10}, {2, 0}, {2, 1}, {0, 1}})), 1);
}

TEST(FindNonConvexCorner, MeasuresTheTurnBySine) {
  const double turn = 1e-3;  // both halves of the lower side slope by turn / 2
  const Points polygon = polygon_of({{-1, 0}, {0, -std::tan(turn / 2)}, {1, 0}, {0, 1}});
  EXPECT_EQ(find_non_convex_corner(polygon, std::sin(turn) * (1 + 1e-9)), 1);
  EXPECT_EQ(find_non_convex_corner(polygon, std::sin(turn) * (1 - 1e-9)), std::nullopt);
}

TEST(FindNonConvexCorner, DoesNotTakeASharpCornerForAStraightOne) {
  const Points needle = polygon_of({{0, 0}, {1, 0}, {0, 1e-6}});
  EXPECT_EQ(find_non_convex_corner(needle, 1e-3), std::nullopt);
}

TEST(Contains, CountsTheBoundaryAndIgnoresTheOrientation) {
  const Points notched = polygon_of({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});
  for (const Points& polygon : {notched, Points(notched.rowwise().reverse())}) {
    for (Index k = 0; k < 5; ++k) {
      EXPECT_TRUE(contains(polygon, polygon.col(k)));
      EXPECT_TRUE(contains(polygon, (polygon.col(k) + polygon.col((k + 1) % 5)) / 2));
    }
    EXPECT_TRUE(contains(polygon, {1, 1}));  // its ray passes through the notch's vertex
    EXPECT_TRUE(contains(polygon, {3.5, 2}));
    EXPECT_FALSE(contains(polygon, {2, 2}));
    EXPECT_FALSE(contains(polygon, {-1, 0}));  // its ray runs along an edge
    EXPECT_FALSE(contains(polygon, {-1, 4}));  // its ray passes through two peaks
    EXPECT_FALSE(contains(polygon, {2, std::nextafter(1., 2.)}));
    EXPECT_TRUE(contains(polygon, {2, std::nextafter(1., 0.)}));
  }
}

TEST(Contains, IsNotDeceivedByRaysThroughVertices) {
  const Points triangle = polygon_of({{0, 0}, {4, 0}, {2, 2}}),
               notch = polygon_of({{0, 0}, {4, 3}, {2, 1}, {1, 4}});
  for (const Points& polygon : {triangle, notch, Points(-triangle), Points(-notch)})
    for (Index k = 0; k < polygon.cols(); ++k) {
      EXPECT_FALSE(contains(polygon, polygon.col(k) - Vec2(10, 0)));
      EXPECT_FALSE(contains(polygon, polygon.col(k) + Vec2(10, 0)));
      EXPECT_FALSE(contains(polygon.rowwise().reverse(), polygon.col(k) - Vec2(10, 0)));
    }
}

TEST(Contains, AgreesWithTheHalfPlanesOfConvexPolygons) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const Points polygon = support::random_convex_polygon(3 + trial % 20, random);
    const Vec2 x(support::uniform(-1, 1, random), support::uniform(-1, 1, random));
    bool left_of_all = true;
    for (Index k = 0; k < polygon.cols(); ++k) {
      const Vec2 a = polygon.col(k), b = polygon.col((k + 1) % polygon.cols());
      left_of_all = left_of_all && cross(b - a, x - a) > 0;
    }
    EXPECT_EQ(contains(polygon, x), left_of_all);
  }
}

TEST(RequireUsable, NamesTheVertexTheReasonAndTheCure) {
  const double nan = std::nan("");
  const std::pair<Points, const char*> cases[] = {
      {Points(2, 0), "give it three at least"},
      {polygon_of({{0, 0}, {1, 0}}), "give it three at least"},
      {polygon_of({{0, 0}, {1, 0}, {nan, 1}, {0, 1}}), "vertex 2 is nowhere: give it finite"},
      {polygon_of({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), "vertex 1 and vertex 2 are at the same place: leave"},
      {polygon_of({{0, 0}, {1, 0}, {2, 0}, {3, 0}}), "vertex 0 and all others lie on one line: move"},
      {polygon_of({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), "edge from vertex 0 meets that from vertex 2: give"},
      {polygon_of({{0, 1}, {1, 1}, {1, 0}, {0, 0}}), "clockwise from vertex 0 on: reverse"}};
  for (const auto& [polygon, words] : cases) try {
      require_usable(polygon);
      ADD_FAILURE() << "accepted, not: " << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  EXPECT_NO_THROW(require_usable(polygon_of({{0, 0}, {2, 0}, {1, 0.5}, {1, 2}})));
}

}  // namespace
