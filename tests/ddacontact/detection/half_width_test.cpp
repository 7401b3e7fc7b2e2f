#include <ddacontact/detection/half_width.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/concave_polygons.hpp>

#include <gtest/gtest.h>

using namespace support;

TEST(HalfWidth, IsTheAreaOverThePerimeterOfConvexPolygons) {
  EXPECT_DOUBLE_EQ(half_width(rectangle(0, 0, 4, 1)), 4. / 10);
  EXPECT_NEAR(half_width(rectangle(0, 0, 1e4, 1)), 0.5, 1e-4) << "half the thickness of a slab";
  EXPECT_DOUBLE_EQ(half_width(points({{0, 0}, {4, 0}, {0, 3}})), 6. / 12);
}

TEST(HalfWidth, OfAConcavePolygonIsHalfThatOfItsThinnestPart) {
  // A leg 5 cm thick stands on a slab.
  const Points leg = points({{0, 0}, {3, 0}, {3, 1}, {2.05, 1}, {2.05, 4}, {2, 3.99}, {2, 0.9}, {0, 1}});
  EXPECT_NEAR(half_width(leg), 0.025, 1e-14);
  Points mirrored = leg.rowwise().reverse();
  mirrored.row(0) *= -1;
  EXPECT_NEAR(half_width(mirrored), 0.025, 1e-14);
  for (const double angle : {0.3, 2., 4.})
    EXPECT_NEAR(half_width(turned(3 * leg, angle).colwise() + Vec2(1e3, -2e3)), 0.075, 1e-10);
}

/// Only what faces the other way is the far side.
TEST(HalfWidth, AShallowStepIsNoThinPart) {
  const Points step = points({{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1.9}, {0, 1.9}});
  EXPECT_DOUBLE_EQ(half_width(step), (4 - 0.1) / 8);
}

/// Vertices beside an edge, not behind it, do not count.
TEST(HalfWidth, PartsSideBySideAreNoThinPart) {
  const Points slabs = points({{0, 0}, {2, 0}, {2, 0.9}, {4, 0.9}, {4, 2}, {1.9, 2}, {1.9, 1}, {0, 1}});
  EXPECT_NEAR(half_width(slabs), 4.3 / 12, 1e-14);
}
