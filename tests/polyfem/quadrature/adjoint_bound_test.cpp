#include <polyfem/quadrature/adjoint_bound.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

/// The sum of the weights of Wachspress functions, a polynomial of degree n - 3, in products of all edges.
double adjoint(const Points& polygon, const Vec2& x) {
  const Index n = polygon.cols();
  const auto vertex = [&](Index i) -> Vec2 { return polygon.col((i + n) % n); };
  double sum = 0;
  for (Index i = 0; i < n; ++i) {
    double weight = cross(vertex(i) - vertex(i - 1), vertex(i + 1) - vertex(i));
    for (Index k = 0; k < n; ++k)
      if (k != i && k != (i + n - 1) % n) weight *= cross(vertex(k) - x, vertex(k + 1) - x);
    sum += weight;
  }
  return sum;
}

class AdjointBounds : public testing::TestWithParam<int> {
 protected:
  std::mt19937 random_{static_cast<unsigned>(GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Vertices, AdjointBounds, testing::Values(3, 4, 5, 6, 8, 12));

TEST_P(AdjointBounds, HaveNoZeroOfTheAdjointWithinThem) {
  for (int trial = 0; trial < 20; ++trial) {
    const Points polygon = support::random_convex_polygon(GetParam(), random_);
    const AdjointBound bound(polygon);
    for (int line = 0; line < 20; ++line) {
      const Vec2 p = support::random_point_in(polygon, random_),
                 q = support::random_point_in(polygon, random_);
      const double reach = std::min(bound.reach(p, q), 100.);
      const double inside = adjoint(polygon, p);
      for (int step = 1; step <= 50; ++step) {
        const Vec2 x = q + (q - p) * reach * 0.999 * step / 50;
        EXPECT_GT(adjoint(polygon, x) * inside, 0);
      }
    }
  }
}

TEST_P(AdjointBounds, AreSharpAlongEdges) {
  if (GetParam() == 3) return;  // no zeros at all
  for (int trial = 0; trial < 20; ++trial) {
    const Points polygon = support::random_convex_polygon(GetParam(), random_);
    const AdjointBound bound(polygon);
    const Vec2 p = polygon.col(0), q = polygon.col(1);
    const double reach = bound.reach(p, q);
    if (reach > 1e3) continue;  // the edges' lines meet on the other side
    const double scale = adjoint(polygon, q);
    EXPECT_LT(std::abs(adjoint(polygon, q + reach * (q - p)) / scale),
              1e-6 * std::pow(1 + reach, GetParam()));
  }
}

TEST_P(AdjointBounds, HaveTheSameDigitsInAnyBinaryUnitOfLength) {
  const Points polygon = support::random_convex_polygon(GetParam(), random_);
  const Vec2 p = support::random_point_in(polygon, random_), q = support::random_point_in(polygon, random_);
  const double reach = AdjointBound(polygon).reach(p, q);
  for (const double unit : {1. / 1024, 8., 1048576.})
    EXPECT_EQ(AdjointBound(unit * polygon).reach(unit * p, unit * q), reach) << unit;
}

TEST(AdjointBoundsOfParallelograms, AreInfinitelyFar) {
  Points polygon(2, 4);
  polygon << -1, 1, 1.5, -0.5,  //
      -1, -1, 1, 1;
  polygon.row(0).array() -= 0.25;
  const AdjointBound bound(polygon);
  EXPECT_GE(bound.reach(Vec2(0, 0), Vec2(0.5, 0.3)), 1e5);
}

}  // namespace
