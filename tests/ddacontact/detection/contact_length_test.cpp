#include <ddacontact/detection/contact_length.hpp>
#include <tests/ddacontact/detection/polygon_pair.hpp>
#include <tests/support/concave_polygons.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using namespace support;

namespace {

bool all_bear(int, int) {
  return true;
}

}  // namespace

/// The two contacts of an overlap stand for half of it each, a lonely vertex for nothing.
TEST(ContactLength, OfAnOverlapAddUpToIt) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 500; ++trial) {
    const double w = uniform(0.5, 3, random), v = uniform(0.5, 3, random),
                 shift = uniform(0.2 - v, w - 0.2, random);
    const PolygonPair pair =
        PolygonPair{box(0, -1, w, 1), box(shift, 0, v, 1)}.moved(uniform(0, 7, random), Vec2(1, 2));
    double sum = 0;
    for (const VertexEdge& c : pair.contacts(0.05)) {
      const double length = contact_length(pair.of(c.vertex_block), pair.of(c.edge_block), c,
                                           pair.of(c.vertex_block), [](int, int) { return true; })
                                .total();
      EXPECT_NEAR(length, (std::min(w, shift + v) - std::max(0., shift)) / 2, 1e-12);
      sum += length;
    }
    EXPECT_NEAR(sum, std::min(w, shift + v) - std::max(0., shift), 1e-12);
  }
}

TEST(ContactLength, OfACornerAloneIsThatOfTheProjectionIfItCountsAtAnyAngle) {
  const Points wedge = points({{1, 0}, {2.5, 1}, {0.4, 1}}), floor = box(0, -1, 2, 1);
  EXPECT_EQ(contact_length(wedge, floor, {0, 0, 1, 2}, wedge, all_bear).total(), 0);
  // Half of the 1 m of floor that lies below the longer of its faces.
  EXPECT_NEAR(contact_length(wedge, floor, {0, 0, 1, 2}, wedge, all_bear, true).total(), 0.5, 1e-14);
}

TEST(ContactLength, IsThatOfTheUnstrainedFace) {
  const Points block = box(1, 0, 2.5, 1), unstrained = box(1, 0, 2, 1);
  EXPECT_NEAR(contact_length(block, box(0, -1, 4, 1), {0, 0, 1, 2}, unstrained, all_bear).total(), 1, 1e-14);
}

/// Of a vertex beyond the end of the edge what lies over the edge counts.
TEST(ContactLength, IsHalfOfTheOverlapFromBeyondAnEndToo) {
  const Points block = box(-0.5, 0, 2, 1);
  EXPECT_NEAR(contact_length(block, box(0, -1, 4, 1), {0, 0, 1, 2}, block, all_bear).total(), 0.75, 1e-14);
}

/// A vertex near the end of an edge where a collinear one follows: its length lies beyond unless a vertex
/// there bears.
TEST(ContactLength, LiesBeyondTheEndOfAnEdgeWhereItsMiddleDoes) {
  const Points floor = points({{0, -1}, {3, -1}, {3, 0}, {1, 0}, {0, 0}});
  for (const double x : {0.9, 0.4}) {
    const Points block = box(x, 0, 2, 1);
    const ContactLength far =
        contact_length(block, floor, {0, 0, 1, 3}, block, [](int b, int) { return b == 0; });
    EXPECT_NEAR(far.on_edge, x > 0.5 ? 0 : 1, 1e-14);
    EXPECT_NEAR(far.beyond, x > 0.5 ? 1 : 0, 1e-14);
    EXPECT_EQ(far.edge_beyond, x > 0.5 ? 2 : -1);
    const ContactLength near = contact_length(block, floor, {0, 0, 1, 3}, block, all_bear);
    EXPECT_NEAR(near.on_edge, (1 - x) / 2, 1e-14);
    EXPECT_EQ(near.beyond, 0);
  }
  const Points block = box(-0.5, 0, 1.6, 1);  // its other end, to the right
  const ContactLength back =
      contact_length(block, floor, {0, 1, 1, 2}, block, [](int b, int) { return b == 0; });
  EXPECT_NEAR(back.beyond, 0.55, 1e-14);
  EXPECT_EQ(back.edge_beyond, 3);
}

/// A vertex on a straight side has parts on both of its sides.
TEST(ContactLength, OfAStraightVertexIsTheSumOfBothWays) {
  const Points block = points({{0, 0}, {1, 0}, {3, 0}, {3, 1}, {0, 1}});
  const ContactLength middle = contact_length(block, box(-1, -1, 9, 1), {0, 1, 1, 2}, block, all_bear);
  EXPECT_NEAR(middle.total(), 0.5 + 1, 1e-14);
  const Points floor = points({{0, -1}, {3, -1}, {3, 0}, {1, 0}, {0, 0}}),
               over_end = points({{0.4, 0}, {0.9, 0}, {2.9, 0}, {2.9, 1}, {0.4, 1}});
  const ContactLength parts =
      contact_length(over_end, floor, {0, 1, 1, 3}, over_end, [](int b, int) { return b == 0; });
  EXPECT_NEAR(parts.on_edge, 0.25, 1e-14);
  EXPECT_NEAR(parts.beyond, 1, 1e-14);
  EXPECT_EQ(parts.edge_beyond, 2);
}

/// A corner stands for the face that lies along the edge, however long the other one is.
TEST(ContactLength, OfACornerIsThatOfTheFaceAlongTheEdge) {
  const Points leaning = points({{0, 0}, {1, 0}, {9, 3}, {0, 3}}), floor = box(-1, -1, 10, 1);
  for (const bool at_any_angle : {false, true})
    for (const int corner : {0, 1})
      EXPECT_NEAR(contact_length(leaning, floor, {0, corner, 1, 2}, leaning, all_bear, at_any_angle).total(),
                  0.5, 1e-14);
}
