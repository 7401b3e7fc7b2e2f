// Contacts of polygons from their outlines.
#include "touching_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace support;

namespace {

Points rectangle(double x, double y, double width, double height) {
  Points outline(2, 4);
  outline << x, x + width, x + width, x,  //
      y, y, y + height, y + height;
  return outline;
}

bool has(const Touching& touching, const Vec2& at, const Vec2& normal) {
  return std::any_of(touching.points.begin(), touching.points.end(), [&](const ContactPoint& point) {
    return (point.at - at).norm() < 1e-12 && (point.normal - normal).norm() < 1e-12;
  });
}

}  // namespace

TEST(TouchingFaces, FacesTouchAtTheEndsOfTheirCommonPart) {
  const Touching touching = touching_faces({rectangle(0, 0, 4, 1), rectangle(1, 1, 7, 1)});
  ASSERT_EQ(touching.points.size(), 2u);
  EXPECT_TRUE(touching.corners.empty());
  EXPECT_TRUE(has(touching, {1, 1}, {0, -1}));  // from the upper block, the second, into the lower one
  EXPECT_TRUE(has(touching, {4, 1}, {0, -1}));
}

TEST(TouchingFaces, LoneCornerTouchesAFaceAtOnePoint) {
  Points tip(2, 3);
  tip << 0, 1, -1, 0, 1, 1;
  EXPECT_TRUE(has(touching_faces({tip, rectangle(-2, -1, 4, 1)}), {0, 0}, {0, 1}));
  const Touching touching = touching_faces({rectangle(-2, -1, 4, 1), tip});
  EXPECT_EQ(touching.points.size(), 1u);
  EXPECT_TRUE(has(touching, {0, 0}, {0, -1}));
}

TEST(TouchingFaces, CrossingOfJointsHasFourFacesAndTwoLoneCorners) {
  const Touching touching = touching_faces(
      {rectangle(0, 0, 1, 1), rectangle(-1, 0, 1, 1), rectangle(-1, -1, 1, 1), rectangle(0, -1, 1, 1)});
  EXPECT_EQ(touching.points.size(), 8u);
  ASSERT_EQ(touching.corners.size(), 2u);
  const CornerContact& corner = touching.corners[0];  // of the upper right block on the lower left one
  EXPECT_EQ(corner.one, 0);
  EXPECT_EQ(corner.other, 2);
  EXPECT_LT((corner.first - Vec2(1, 0)).norm(), 1e-12);
  EXPECT_LT((corner.last - Vec2(0, 1)).norm(), 1e-12);
}

TEST(TouchingFaces, BlocksApartDoNotTouch) {
  const Touching touching = touching_faces({rectangle(0, 0, 1, 1), rectangle(1 + 1e-6, 0, 1, 1)});
  EXPECT_TRUE(touching.points.empty());
  EXPECT_TRUE(touching.corners.empty());
}
