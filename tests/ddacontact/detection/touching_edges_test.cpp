#include <ddacontact/detection/touching_edges.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

constexpr double nearness = 1e-6;

void expect_one_touch(const std::vector<TouchingEdges>& found, const TouchingEdges& expected) {
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].edge, expected.edge);
  EXPECT_EQ(found[0].other, expected.other);
  EXPECT_NEAR(found[0].from, expected.from, 1e-9);
  EXPECT_NEAR(found[0].to, expected.to, 1e-9);
}

}  // namespace

TEST(TouchingEdges, AreToldInFractionsOfTheFirst) {
  const Points left = rectangle(-3, 0, 4, 2), right = rectangle(1, -1, 2, 1.5);
  for (const double angle : {0., 1., 4.})
    for (const Vec2& by : {Vec2(0, 0), Vec2(1e6, -2e6)}) {
      const Points a = turned(left, angle).colwise() + by, b = turned(right, angle).colwise() + by;
      expect_one_touch(touching_edges(a, b, nearness), {1, 3, 0, 0.25});
      expect_one_touch(touching_edges(b, a, nearness), {3, 1, 0, 0.5 / 1.5});
    }
  expect_one_touch(touching_edges(left, rectangle(1, 0.5, 1, 0.5), nearness), {1, 3, 0.25, 0.5});
  expect_one_touch(touching_edges(rectangle(1, 0.5, 1, 0.5), left, nearness), {3, 1, 0, 1});
}

TEST(TouchingEdges, LieWithinTheDistanceAlongMoreThanThat) {
  const Points square = rectangle(0, 0, 1, 1);
  for (const double gap : {-2e-6, -0.9e-6, 0., 0.9e-6, 2e-6})
    EXPECT_EQ(touching_edges(square, rectangle(1 + gap, 0.1, 1, 0.5), nearness).size(),
              std::abs(gap) < nearness);
  for (const double along : {-1e-3, 0., 0.5e-6, 2e-6})
    EXPECT_EQ(touching_edges(square, rectangle(1, 1 - along, 1, 1), nearness).size(), along > nearness)
        << along;
  for (const double y : {0., 1.})  // one end apart
    EXPECT_TRUE(
        touching_edges(square, turned(rectangle(1, 0, 1, 1), 0.1 * (2 * y - 1), {1, y}), nearness).empty());
}

TEST(TouchingEdges, AreThoseThatRunTheSameWayToo) {
  for (const TouchingEdges& of : touching_edges(rectangle(0, 0, 1, 1), rectangle(0, 0, 1, 0.25), nearness)) {
    EXPECT_EQ(of.edge, of.other);
    EXPECT_EQ(of.from, of.edge == 3 ? 0.75 : 0);
    EXPECT_EQ(of.to, of.edge == 1 ? 0.25 : 1);
  }
  EXPECT_EQ(touching_edges(rectangle(0, 0, 1, 1), rectangle(0, 0, 1, 0.25), nearness).size(), 3u);
}
