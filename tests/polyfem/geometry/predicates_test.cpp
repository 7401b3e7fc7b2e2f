#include <polyfem/geometry/predicates.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace polyfem;

namespace {

__extension__ typedef __int128 Wide;

int sign(Wide x) {
  return (x > 0) - (x < 0);
}

/// The oracle: coordinates that are multiples of 2^-53 below 64, evaluated in integers.
int orientation_in_integers(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto scaled = [](double x) { return static_cast<Wide>(std::ldexp(x, 53)); };
  const Wide bax = scaled(b.x()) - scaled(a.x()), bay = scaled(b.y()) - scaled(a.y());
  const Wide cax = scaled(c.x()) - scaled(a.x()), cay = scaled(c.y()) - scaled(a.y());
  return sign(bax * cay - bay * cax);
}

int naive_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double determinant = cross(b - a, c - a);
  return (determinant > 0) - (determinant < 0);
}

// The grid on which the floating-point determinant shows its fringes (Kettner et al., "Classroom examples of
// robustness problems in geometric computations", 2008).
TEST(Orientation, IsExactOnTheClassicGridOfNearlyCollinearPoints) {
  const Vec2 b(12, 12), c(24, 24);
  int naive_errors = 0;
  for (int i = 0; i < 256; ++i)
    for (int j = 0; j < 256; ++j) {
      const Vec2 a(0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53);
      const int exact = orientation_in_integers(a, b, c);
      ASSERT_EQ(orientation(a, b, c), exact) << i << ", " << j;
      naive_errors += naive_orientation(a, b, c) != exact;
    }
  EXPECT_GT(naive_errors, 1000) << "the grid no longer provokes round-off";
}

class OrientationNearCollinear : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Bits, OrientationNearCollinear, testing::Values(10, 25, 40, 50, 52));

TEST_P(OrientationNearCollinear, AgreesWithIntegersAndIsAntisymmetric) {
  std::mt19937_64 random(3);
  const std::int64_t range = std::int64_t{1} << GetParam();
  std::uniform_int_distribution<std::int64_t> coordinate(-range, range), nudge(-1, 1);
  for (int trial = 0; trial < 20000; ++trial) {
    std::array<Vec2, 3> p;
    const Vec2 step(static_cast<double>(coordinate(random) / 4), static_cast<double>(coordinate(random) / 4));
    p[0] = Vec2(static_cast<double>(coordinate(random) / 4), static_cast<double>(coordinate(random) / 4));
    p[1] = p[0] + step;
    p[2] = p[0] + 3 * step + Vec2(static_cast<double>(nudge(random)), static_cast<double>(nudge(random)));
    for (Vec2& point : p) point *= 0x1p-53 * 4;  // exact
    const int exact = orientation_in_integers(p[0], p[1], p[2]);
    ASSERT_EQ(orientation(p[0], p[1], p[2]), exact);
    ASSERT_EQ(orientation(p[1], p[2], p[0]), exact);
    ASSERT_EQ(orientation(p[2], p[1], p[0]), -exact);
    ASSERT_EQ(orientation(p[0], p[2], p[1]), -exact);
  }
}

TEST(Orientation, SeesHalfAnUlpAtLargeAndSmallScales) {
  for (const double scale : {1e-100, 1e-6, 1., 1e6, 1e100}) {
    const Vec2 a(0.1 * scale, 0.1 * scale), b(0.7 * scale, 0.7 * scale);
    const double x = 0.3 * scale, above = std::nextafter(x, 2 * x), below = std::nextafter(x, 0.);
    EXPECT_EQ(orientation(a, b, Vec2(x, x)), 0);
    EXPECT_EQ(orientation(a, b, Vec2(x, above)), 1);
    EXPECT_EQ(orientation(a, b, Vec2(x, below)), -1);
  }
}

TEST(OnSegment, HoldsForItsEndsAndExactPointsBetweenOnly) {
  const Vec2 a(1, 1), b(4, 3);
  EXPECT_TRUE(on_segment(a, b, a));
  EXPECT_TRUE(on_segment(a, b, b));
  EXPECT_TRUE(on_segment(a, b, Vec2(2.5, 2)));
  EXPECT_FALSE(on_segment(a, b, Vec2(2.5, std::nextafter(2., 3.))));
  EXPECT_FALSE(on_segment(a, b, Vec2(7, 5)));
  EXPECT_TRUE(on_segment(a, a, a));
  EXPECT_FALSE(on_segment(a, a, b));
}

/// The oracle for small integer coordinates: solves for the parameters of the common point.
bool intersect_by_parameters(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 u = b - a, v = d - c, w = c - a;
  const double determinant = cross(u, v);
  if (determinant != 0) {
    const double s = cross(w, v) / determinant, t = cross(w, u) / determinant;  // 0 and 1 come out exactly
    return s >= 0 && s <= 1 && t >= 0 && t <= 1;
  }
  if (cross(u, w) != 0 || cross(v, w) != 0) return false;
  const auto overlap = [&](int axis) {
    return std::max(std::min(a[axis], b[axis]), std::min(c[axis], d[axis])) <=
           std::min(std::max(a[axis], b[axis]), std::max(c[axis], d[axis]));
  };
  return overlap(0) && overlap(1);
}

TEST(SegmentsIntersect, AgreesWithParametersOnEverySmallLattice) {
  // All pairs of segments with ends on a 3 x 3 lattice: crossings, touches, overlaps, points.
  const auto lattice = [](int i) { return Vec2(i % 3, i / 3); };
  for (int a = 0; a < 9; ++a)
    for (int b = 0; b < 9; ++b)
      for (int c = 0; c < 9; ++c)
        for (int d = 0; d < 9; ++d)
          ASSERT_EQ(segments_intersect(lattice(a), lattice(b), lattice(c), lattice(d)),
                    intersect_by_parameters(lattice(a), lattice(b), lattice(c), lattice(d)))
              << a << b << c << d;
}

TEST(SegmentsIntersect, DecidesByTheLastBit) {
  const Vec2 a(0.1, 0.1), b(0.7, 0.7), c(0.3, 1);
  EXPECT_TRUE(segments_intersect(a, b, c, Vec2(0.3, 0.3)));
  EXPECT_TRUE(segments_intersect(a, b, c, Vec2(0.3, std::nextafter(0.3, 0.))));
  EXPECT_FALSE(segments_intersect(a, b, c, Vec2(0.3, std::nextafter(0.3, 1.))));
}

}  // namespace
