#include <ddacontact/detection/outline_table.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/concave_polygons.hpp>

#include <gtest/gtest.h>

#include <array>

using namespace support;

namespace {

void expect_sides_of(const OutlineSides& of, const Points& outline) {
  ASSERT_EQ(static_cast<Index>(of.sides.size()), outline.cols());
  for (int k = 0; k < outline.cols(); ++k) {
    const Side& side = of.sides[static_cast<std::size_t>(k)];
    const Vec2 along = outline.col(next(k, outline)) - outline.col(k);
    EXPECT_LE((side.along() - along).norm(), 1e-15 * along.norm());
    EXPECT_NEAR(side.tangent.norm(), 1, 1e-15);
    EXPECT_NEAR(cross(side.normal(), side.tangent), 1, 1e-15) << "outward is to the right";
    EXPECT_EQ(side.corner, corner_at(outline, k));
  }
  EXPECT_EQ(of.box.low, Vec2(outline.rowwise().minCoeff()));
  EXPECT_EQ(of.box.high, Vec2(outline.rowwise().maxCoeff()));
}

}  // namespace

TEST(OutlineTable, KeepsSidesAndBoxesOfEachPolygon) {
  const Points square = rectangle(-2, 1, 3, 4),
               notched = points({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 3}});
  OutlineTable table(std::array{4, 6});
  table.set(1, notched);
  table.set(0, square);
  expect_sides_of(table[0], square);
  expect_sides_of(table[1], notched);
  EXPECT_FALSE(table[0].concave);
  EXPECT_TRUE(table[1].concave);
  table.set(1, turned(notched, 1));
  expect_sides_of(table[0], square);
  expect_sides_of(table[1], turned(notched, 1));
}

TEST(OutlineTable, ConcaveIsWhatTurnsRightHoweverLittle) {
  for (const double bend : {-1e-9, 0., 1e-9}) {
    OutlineTable table(std::array{5});
    table.set(0, points({{0, 0}, {1, bend}, {2, 0}, {2, 1}, {0, 1}}));
    EXPECT_EQ(table[0].concave, bend > 0) << bend;
    EXPECT_EQ(table[0].sides[1].corner, Corner::straight);
  }
}
