#include <ddacontact/detection/broad_phase.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <functional>

using namespace ddacontact;

namespace {

Box box_between(const Vec2& low, const Vec2& size) {
  return {low, low + size};
}

/// n boxes drawn one by one, of `trials` sets.
void expect_all_pairs(const char* what, int trials, const std::function<Box(std::mt19937&)>& draw) {
  std::mt19937 random(11);
  std::size_t n_pairs = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<Box> boxes;
    const int n = std::uniform_int_distribution<int>(0, 60)(random);
    for (int i = 0; i < n; ++i) boxes.push_back(draw(random));
    std::vector<Pair> expected;
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j) {
        const Vec2 low = boxes[i].low.cwiseMax(boxes[j].low), high = boxes[i].high.cwiseMin(boxes[j].high);
        if (low.x() <= high.x() && low.y() <= high.y()) expected.push_back({i, j});
      }
    ASSERT_EQ(overlapping_pairs(boxes), expected) << what << ", trial " << trial << ", " << n << " boxes";
    n_pairs += expected.size();
  }
  EXPECT_GT(n_pairs, 0u) << what;
}

double draw(double from, double to, std::mt19937& random) {
  return support::uniform(from, to, random);
}
Vec2 point(double side, std::mt19937& random) {
  return {draw(0, side, random), draw(0, side, random)};
}
/// A point of the integer grid: boxes on it touch exactly.
Vec2 grid_point(int side, std::mt19937& random) {
  std::uniform_int_distribution<int> d(0, side);
  return Vec2(d(random), d(random));
}

}  // namespace

/// Of equal and different sizes, touching, without extent, the same ones, far from the origin and from each
/// other.
TEST(BroadPhase, FindsAllPairsOfBoxesOfAnyKind) {
  expect_all_pairs("equal", 500, [](auto& r) { return box_between(point(8, r), {1, 1}); });
  expect_all_pairs("1:100", 500, [](auto& r) {
    const double size = std::pow(10, draw(-1, 1, r));
    return box_between(point(60, r), {size * draw(0.1, 1, r), size * draw(0.1, 1, r)});
  });
  expect_all_pairs("touching", 500, [](auto& r) { return box_between(grid_point(12, r), {1, 1}); });
  expect_all_pairs("touching, sizes", 500,
                   [](auto& r) { return box_between(grid_point(30, r), grid_point(4, r)); });
  expect_all_pairs("points", 200, [](auto& r) { return box_between(grid_point(5, r), {0, 0}); });
  expect_all_pairs("mixed", 500, [](auto& r) {
    return box_between(grid_point(8, r), Vec2(r() % 2 ? 2 : 0, r() % 3 ? 0 : 1));
  });
  expect_all_pairs("identical", 100, [](auto&) { return box_between({3, 4}, {1, 2}); });
  expect_all_pairs("identical points", 100, [](auto&) { return box_between({3, 4}, {0, 0}); });
  expect_all_pairs("far away", 300, [](auto& r) {
    return box_between(Vec2(5e5, -4e6) + point(8, r), {1, 1});
  });
  expect_all_pairs("two clusters", 300, [](auto& r) {
    return box_between(Vec2(r() % 2 ? 0 : 1e12, r() % 2 ? 0 : 1e12) + grid_point(6, r), {1, 1});
  });
  expect_all_pairs("on a line", 300, [](auto& r) { return box_between(Vec2(draw(0, 30, r), 0), {1, 1e-9}); });
}

TEST(BroadPhase, AWidenedBoxHoldsThePolygonAndItsMargin) {
  std::mt19937 random(5);
  for (int n = 3; n < 9; ++n) {
    const polyfem::Points polygon = support::random_convex_polygon(n, random);
    const Box b = bounding_box(polygon, 0.25);
    EXPECT_LE(((b.low + Vec2::Constant(0.25)) - polygon.rowwise().minCoeff()).norm(), 1e-15);
    EXPECT_LE(((b.high - Vec2::Constant(0.25)) - polygon.rowwise().maxCoeff()).norm(), 1e-15);
  }
}

TEST(BroadPhase, AWallOfManyBoxesIsFoundInTimeProportionalToThem) {
  std::vector<Box> boxes;
  const int rows = 200, columns = 200;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) boxes.push_back(box_between(Vec2(c, r), {1, 1}));
  EXPECT_EQ(overlapping_pairs(boxes).size(),
            std::size_t(rows * (columns - 1) * 2 + 2 * (rows - 1) * (columns - 1)));
}
