#include <polyfem/basis/edge_area.hpp>
#include <tests/support/exact_shape_functions.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

support::Real exact_area(const Vec2& from, const Vec2& to, const Vec2& x) {
  using support::Real;
  return (Real(from.x()) - x.x()) * (Real(to.y()) - from.y()) -
         (Real(from.y()) - x.y()) * (Real(to.x()) - from.x());
}

TEST(EdgeArea, IsExactToRoundOffHoweverCloseThePointIsToTheLine) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec2 offset = std::pow(10, support::uniform(-3, 6, random)) * support::random_direction(random);
    const Vec2 from = offset + support::random_direction(random),
               to = offset + support::random_direction(random);
    const double height = std::pow(10, support::uniform(-17, 0, random));
    const Vec2 x =
        from + support::uniform(-1, 2, random) * (to - from) + height * support::random_direction(random);
    const support::Real exact = exact_area(from, to, x);
    const double length = (to - from).norm(), reach = (from - x).norm();
    const double plain = PlainEdge(from, to).area(in_all_lanes(x))[0],
                 precise = PreciseEdge(from, to).area(in_all_lanes(x))[0];
    ASSERT_LT(abs(plain - exact), 3 * epsilon * reach * length);
    ASSERT_LT(abs(precise - exact), 2 * epsilon * abs(exact) + 0x1p-77 * reach * length);
  }
}

TEST(EdgeArea, OfAnEndIsZero) {
  const Vec2 from(0.1, 0.7), to(1.3, -0.9);
  EXPECT_EQ(PlainEdge(from, to).area(in_all_lanes(from))[0], 0);
  EXPECT_EQ(PreciseEdge(from, to).area(in_all_lanes(from))[0], 0);
  EXPECT_EQ(PreciseEdge(from, to).area(in_all_lanes(to))[0], 0);
}

}  // namespace
