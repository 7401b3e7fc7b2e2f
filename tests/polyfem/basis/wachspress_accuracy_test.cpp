// Values and gradients against 50 digits, over everything that makes them hard.
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/corner_turn.hpp>
#include <tests/support/exact_shape_functions.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace polyfem;

namespace {

double log_uniform(double from, double to, std::mt19937& random) {
  return std::exp(support::uniform(std::log(from), std::log(to), random));
}

/// The polygon with a corner cut off at fractions s and t of its two edges.
Points cut_corner(const Points& polygon, Index corner, double s, double t) {
  const Index n = polygon.cols();
  Points cut(2, n + 1);
  cut.leftCols(corner) = polygon.leftCols(corner);
  cut.col(corner) = (1 - s) * polygon.col(corner) + s * polygon.col((corner + n - 1) % n);
  cut.col(corner + 1) = (1 - t) * polygon.col(corner) + t * polygon.col((corner + 1) % n);
  cut.rightCols(n - corner - 1) = polygon.rightCols(n - corner - 1);
  return cut;
}

double smallest_turn(const Points& polygon) {
  return least_turn(static_cast<int>(polygon.cols()), [&](int k) -> Vec2 { return polygon.col(k); });
}

enum class Shape { regular_sides, tiny_edges, straight_corners, both };

/// A convex n-gon, some of whose corners come from cutting others: close together, or turning by down to
/// 1e-3.
Points hard_polygon(int n, Shape shape, std::mt19937& random) {
  int n_cuts =
      shape == Shape::regular_sides ? 0 : std::uniform_int_distribution(0, std::min(5, n - 3))(random);
  Points polygon = support::random_convex_polygon(n - n_cuts, random);
  while (n_cuts > 0) {
    const double s = shape == Shape::straight_corners ? support::uniform(0.05, 0.4, random)
                                                      : log_uniform(1e-8, 0.4, random);
    const double ratio = log_uniform(1e-3, 1e3, random);
    const double t = s * (shape == Shape::tiny_edges ? support::uniform(0.3, 3, random) : ratio);
    const Index corner = std::uniform_int_distribution<Index>(0, polygon.cols() - 1)(random);
    if (t > 0.4) continue;
    const Points cut = cut_corner(polygon, corner, s, t);
    if (smallest_turn(cut) < 1e-3) continue;
    polygon = cut;
    --n_cuts;
  }
  return polygon;
}

/// Points of the closed polygon: inside, at all distances from an edge and from a vertex, on them.
Points points_of(const Points& polygon, std::mt19937& random) {
  std::vector<Vec2> points;
  for (int i = 0; i < 2; ++i) {
    const Index k = std::uniform_int_distribution<Index>(0, polygon.cols() - 1)(random);
    const Vec2 a = polygon.col(k), edge = polygon.col((k + 1) % polygon.cols()) - a;
    const Vec2 inside = support::random_point_in(polygon, random);
    points.push_back(inside);
    points.push_back(a);
    for (const double s : {0., support::uniform(0, 1, random), log_uniform(1e-17, 1, random)}) {
      const Vec2 on_edge = a + s * edge;
      points.push_back(on_edge);
      points.push_back(on_edge + log_uniform(1e-17, 1, random) * (inside - on_edge));
    }
  }
  return Eigen::Map<Points>(points.front().data(), 2, static_cast<Index>(points.size()));
}

/// Rounding may have moved a point out by many times the size of the polygon's smallest features.
bool is_in(const std::vector<support::ExactShape>& exact) {
  return std::ranges::all_of(exact, [](const support::ExactShape& N) { return N.value > -1e-6; });
}

/// The error of values and that of gradients are bounded where the points are in the polygon.
void expect_errors_below(double tolerance, const Points& polygon, const Points& points) {
  ShapeTable table;
  wachspress.evaluate(polygon, points, table);
  for (Index q = 0; q < points.cols(); ++q) {
    const std::vector<support::ExactShape> exact = support::exact_wachspress(polygon, points.col(q));
    if (!is_in(exact)) continue;
    const support::ShapeErrors errors = support::shape_errors(table, q, exact);
    ASSERT_LT(errors.value, tolerance) << "point " << q;
    ASSERT_LT(errors.gradient, tolerance) << "point " << q;
  }
}

class WachspressAccuracy : public testing::TestWithParam<std::tuple<int, Shape>> {};
INSTANTIATE_TEST_SUITE_P(VerticesAndShapes, WachspressAccuracy,
                         testing::Combine(testing::Values(3, 4, 5, 6, 8, 12, 20, 50, 100),
                                          testing::Values(Shape::regular_sides, Shape::tiny_edges,
                                                          Shape::straight_corners, Shape::both)));

TEST_P(WachspressAccuracy, IsRoundOffAtEverySizeOffsetAndDistanceFromTheBoundary) {
  const auto [n, shape] = GetParam();
  std::mt19937 random(static_cast<unsigned>(n));
  const int n_polygons = 4 + 120 / n;
  for (int trial = 0; trial < n_polygons; ++trial) {
    const double size = log_uniform(1e-6, 1e6, random);
    const double distance = trial % 2 == 0 ? 0 : log_uniform(1, 1e8, random);
    const Vec2 offset = distance * size * support::random_direction(random);
    const Points polygon = (size * hard_polygon(n, shape, random)).colwise() + offset;
    if (smallest_turn(polygon) < 1e-3) continue;  // by the rounding of its coordinates
    SCOPED_TRACE(testing::Message() << "size " << size << ", distance " << distance);
    // measured over 1e4 polygons: 2e-15 and 6e-15
    ASSERT_NO_FATAL_FAILURE(expect_errors_below(1e-14, polygon, points_of(polygon, random)));
  }
}

/// A square with a corner added to its lower side, which it divides in the ratio 3 : 7.
Points nearly_straight(double turn) {
  Points polygon(2, 5);
  polygon << 0, 0.3, 1, 1, 0,  //
      0, -0.21 * turn, 0, 1, 1;
  return polygon;
}

class WachspressTurn : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Turn, WachspressTurn,
                         testing::Values(0.2, 0.051, 0.049, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14));

TEST_P(WachspressTurn, LosesFarLessThanRoundOffOverTheTurn) {
  const Points polygon = nearly_straight(GetParam());
  const double tolerance =
      1e-14 + 1e-19 / GetParam();  // measured: 2e-14 at 1e-6, 5e-14 at 1e-8, 1e-11 at 1e-10
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial)
    ASSERT_NO_FATAL_FAILURE(expect_errors_below(tolerance, polygon, points_of(polygon, random)));
}

TEST(WachspressTinyEdge, LosesNoDigits) {
  std::mt19937 random(11);
  const Points square = support::regular_polygon(4);
  for (const double length : {1e-2, 1e-4, 1e-6, 1e-8, 1e-12})
    for (int trial = 0; trial < 10; ++trial) {
      const Points polygon = cut_corner(square, 2, length, length);
      ASSERT_NO_FATAL_FAILURE(expect_errors_below(1e-14, polygon, points_of(polygon, random)));
    }
}

TEST(WachspressTinyEdgeOfSmallTurns, IsExactWhereItIsSeenFromFar) {
  std::mt19937 random(4);
  ShapeTable table;
  for (int trial = 0; trial < 200; ++trial) {
    Points polygon(2, 5), x(2, 1);
    polygon << -1, 0, 1e-7, 1, 0.3,  //
        1.1e-3, 0, 0, 1.1e-3, 1;
    x << log_uniform(1e-7, 1e-4, random), log_uniform(1e-6, 1e-4, random);
    const Vec2 axis = support::random_direction(random);
    Mat2 rotation;
    rotation << axis.x(), -axis.y(), axis.y(), axis.x();
    polygon = rotation * polygon;
    x = rotation * x;
    wachspress.evaluate(polygon, x, table);
    const auto errors = support::shape_errors(table, 0, support::exact_wachspress(polygon, x.col(0)));
    ASSERT_LT(errors.value, 1e-14);
    ASSERT_LT(errors.gradient, 1e-14);
  }
}

TEST(WachspressBatches, APointHasTheSameBytesWhateverThePointsBesideIt) {
  std::mt19937 random(5);
  ShapeTable all, some;
  for (const int n : {3, 4, 7, 30}) {
    for (const Shape shape : {Shape::regular_sides, Shape::both}) {
      const Points polygon = hard_polygon(n, shape, random);
      Points points(2, 21);
      points << points_of(polygon, random), points_of(polygon, random).leftCols(5);
      wachspress.evaluate(polygon, points, all);
      for (const Index batch : {1, 2, 3, 4, 7, 8, 9, 16, 20}) {
        for (Index from = 0; from + batch <= points.cols(); from += batch) {
          wachspress.evaluate(polygon, points.middleCols(from, batch), some);
          ASSERT_EQ(some.values, all.values.middleRows(from, batch));
          ASSERT_EQ(some.dx, all.dx.middleRows(from, batch));
          ASSERT_EQ(some.dy, all.dy.middleRows(from, batch));
        }
      }
    }
  }
}

}  // namespace
