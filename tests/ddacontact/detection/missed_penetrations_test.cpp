#include <ddacontact/detection/missed_penetrations.hpp>
#include <tests/ddacontact/detection/polygon_pair.hpp>
#include <tests/support/concave_polygons.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using namespace support;

namespace {

constexpr double tolerance = 1e-5;

std::vector<VertexEdge> entries(const Points& fixed, const Points& moving, const Vec2& by) {
  const Points moved = moving.colwise() + by;
  std::vector<VertexEdge> found;
  find_missed_penetrations({0, fixed, fixed}, {1, moving, moved}, tolerance, found);
  return found;
}

const Points floor_box = box(0, -1, 4, 1);
/// Tip at the bottom, vertex 0.
const Points tip = points({{0, 0}, {1, 2}, {-1, 2}});

Points at(const Points& polygon, double x, double y) {
  return polygon.colwise() + Vec2(x, y);
}

}  // namespace

TEST(Entries, TellWhichEdgeAVertexWentThrough) {
  const std::vector<VertexEdge> through_top{{1, 0, 0, 2}};
  EXPECT_EQ(entries(floor_box, at(tip, 1, 0.1), {0.3, -0.2}), through_top);
  // Either end may be the one that moves.
  EXPECT_EQ(entries(at(tip, 1, 0.1), floor_box, {0.3, 0.2}), (std::vector<VertexEdge>{{0, 0, 1, 2}}));
  EXPECT_TRUE(entries(floor_box, at(tip, 1, 0.1), {0.3, -0.1}).empty()) << "on the edge";
  EXPECT_TRUE(entries(floor_box, at(tip, 1, 0.1), {0.3, 0.1}).empty()) << "away";
}

TEST(Entries, LeaveOutWhatWasInsideBefore) {
  EXPECT_TRUE(entries(floor_box, at(tip, 1, -0.1), {0, -0.1}).empty());
  EXPECT_FALSE(entries(floor_box, at(tip, 1, -tolerance / 2), {0, -0.1}).empty());
}

/// Of the two edges at a corner the one crossed, not the one whose line is crossed beside it.
TEST(Entries, ByACornerGoThroughTheEdgeThatIsCrossed) {
  const Points needle = points({{0, 0}, {-2, 0.05}, {-2, -0.05}});
  EXPECT_EQ(entries(floor_box, at(needle, -0.1, -0.1), {0.2, 0}), (std::vector<VertexEdge>{{1, 0, 0, 3}}));
  EXPECT_EQ(entries(floor_box, at(needle, -0.1, 0.1), {0.3, -0.15}), (std::vector<VertexEdge>{{1, 0, 0, 2}}));
}

TEST(Entries, PassACornerThatIsNotTouched) {
  const Points square = box(4.001, 0.001, 1, 1);
  EXPECT_TRUE(entries(floor_box, square, {-0.5, 0}).empty());
  EXPECT_TRUE(entries(floor_box, square, {0, -0.5}).empty());
}

TEST(Entries, OfAConcavePolygonAreThoseOfItsEdges) {
  const Points L = points({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  EXPECT_TRUE(entries(L, box(1.2, 1.2, 0.5, 0.5), {-0.1, -0.1}).empty()) << "stays in the corner";
  const auto found = entries(L, box(1.2, 1.2, 0.5, 0.5), {0, -0.3});
  EXPECT_EQ(found, (std::vector<VertexEdge>{{1, 0, 0, 2}, {1, 1, 0, 2}}));
}
