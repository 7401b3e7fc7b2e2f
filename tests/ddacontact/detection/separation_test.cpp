#include <ddacontact/detection/separation.hpp>
#include <tests/support/overlap_area.hpp>
#include <tests/support/random_shapes.hpp>

#include <gtest/gtest.h>

#include <algorithm>

using namespace support;

namespace {

/// The smallest distance of the origin from an edge of the convex hull of a - b, < 0 when it lies inside: the
/// hull is intersected from half planes through all pairs of points that have all others on one side.
double minkowski_separation(const Points& a, const Points& b) {
  std::vector<Vec2> difference;
  for (Index i = 0; i < a.cols(); ++i)
    for (Index j = 0; j < b.cols(); ++j) difference.push_back(a.col(i) - b.col(j));
  double largest = -1e300;
  for (const Vec2& p : difference)
    for (const Vec2& q : difference) {
      if ((q - p).norm() < 1e-9) continue;
      const Vec2 outward = Vec2((q - p).y(), -(q - p).x()).normalized();
      if (std::all_of(difference.begin(), difference.end(),
                      [&](const Vec2& r) { return outward.dot(r - p) < 1e-12; }))
        largest = std::max(largest, -outward.dot(p));
    }
  return largest;
}

}  // namespace

TEST(Separation, IsTheLargestDistanceFromAnEdgeOfTheMinkowskiDifference) {
  std::mt19937 random(3);
  int apart = 0, overlapping = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Points a = random_convex_polygon(3 + trial % 4, random);
    const Points b = random_convex_polygon(3 + trial % 3, random).colwise() +
                     uniform(0, 2.5, random) * random_direction(random);
    const double s = ddacontact::separation(a, b);
    EXPECT_NEAR(s, minkowski_separation(a, b), 1e-11);
    EXPECT_NEAR(s, ddacontact::separation(b, a), 1e-14);
    ++(s > 0 ? apart : overlapping);
  }
  EXPECT_GT(apart, 20);
  EXPECT_GT(overlapping, 20);
}

/// Moving b away by the depth along the best direction just parts the polygons.
TEST(Separation, OfTwoBoxesIsTheirGapOrTheirLeastOverlap) {
  Points unit(2, 4);
  unit << 0, 1, 1, 0, 0, 0, 1, 1;
  const auto at = [&](double x, double y) -> Points { return unit.colwise() + Vec2(x, y); };
  EXPECT_DOUBLE_EQ(ddacontact::separation(unit, at(1.5, 0)), 0.5);
  EXPECT_DOUBLE_EQ(ddacontact::separation(unit, at(1, 0.5)), 0);
  EXPECT_DOUBLE_EQ(ddacontact::separation(unit, at(0.75, 0.5)), -0.25);
  EXPECT_DOUBLE_EQ(ddacontact::separation(unit, at(3, -5)), 4);
}

TEST(Separation, OfAnyPolygonsIsNegativeWhereTheyHaveAreaInCommon) {
  std::mt19937 random(4);
  int apart = 0, overlapping = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Points a = random_shape(random);
    const Points b = (std::pow(30, -uniform(0, 1, random)) * random_shape(random)).colwise() +
                     uniform(0, 2, random) * random_direction(random);
    const double s = ddacontact::separation(a, b), area = overlap_area(a, b);
    EXPECT_DOUBLE_EQ(s, ddacontact::separation(b, a));
    if (std::abs(s) < 1e-9) continue;
    EXPECT_EQ(s<0, area> 1e-14) << "trial " << trial << ": " << s << ", " << area;
    ++(s > 0 ? apart : overlapping);
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(overlapping, 500);
}

/// Exact coordinates, whatever lies along or in a corner: no overlap, and one as soon as they move together.
TEST(Separation, OfPolygonsThatFitTogetherIsNothing) {
  const Points l = points({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  const Points rest = points({{2, 1}, {2, 2}, {1, 2}, {1, 1}});
  const Points comb = points({{0, 3}, {0, 2}, {1, 2}, {1, 1}, {2, 1}, {2, 3}});
  for (const Points& other : {rest, comb}) {
    EXPECT_EQ(ddacontact::separation(l, other), 0);
    EXPECT_EQ(ddacontact::separation(other, l), 0);
    for (const Vec2& by : {Vec2(-1e-15, 0), Vec2(0, -1e-15), Vec2(-1e-9, 1e-9)})
      EXPECT_LT(ddacontact::separation(l, other.colwise() + by), 0) << by.transpose();
    EXPECT_NEAR(ddacontact::separation(l, other.colwise() + Vec2(-0.01, 0)), -0.01, 1e-12);
  }
  // In the notch, in touch with neither side.
  EXPECT_NEAR(ddacontact::separation(l, rest.colwise() + Vec2(0.1, 0.2)), 0.1, 0.1);
  EXPECT_GT(ddacontact::separation(l, rest.colwise() + Vec2(0.1, 0.2)), 0);
}

/// A plate pushed into a side by so much overlaps by so much.
TEST(Separation, OfAPlateInASideOfAnyPolygonIsItsDepth) {
  std::mt19937 random(5);
  for (const NamedPolygon& named : concave_polygons()) {
    const Points& polygon = named.points;
    for (Index e = 0; e < polygon.cols(); ++e) {
      const Vec2 from = polygon.col(e), along = polygon.col((e + 1) % polygon.cols()) - from;
      const Vec2 tangent = along.normalized(), outward(tangent.y(), -tangent.x());
      const double depth = 1e-2 * along.norm(), width = 0.2 * along.norm();
      const Vec2 low = from + 0.4 * along - depth * outward;
      const Points plate = points({low, low + depth * 1.5 * outward,
                                   low + width * tangent + depth * 1.5 * outward, low + width * tangent});
      const Points turned = plate.rowwise().reverse();
      const Points& ccw = polyfem::signed_area(plate) > 0 ? plate : turned;
      EXPECT_NEAR(ddacontact::separation(polygon, ccw), -depth, 0.01 * depth) << named.name << " " << e;
    }
  }
}
