#include <ddacontact/detection/separation.hpp>
#include <tests/support/random_polygon.hpp>

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
