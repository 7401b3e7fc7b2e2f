// The quick form of mean value functions: right where it says that it may be used, and used there.
#include <polyfem/basis/mean_value_far.hpp>
#include <polyfem/basis/packets.hpp>
#include <polyfem/testing/sample_polygons.hpp>
#include <tests/polyfem/basis/exact_mean_value.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

class MeanValueFar : public testing::TestWithParam<int> {
 protected:
  /// Whether the point is far; its functions go to `shape`.
  bool is_far(const Points& polygon, const Vec2& x, ShapeValues& shape) {
    resize(table_, n_lanes, polygon.cols());
    if (!far_.set(polygon) || !far_.evaluate(in_all_lanes(x), 0, table_)[0]) return false;
    shape.values = table_.values.row(0);
    shape.gradients.resize(2, polygon.cols());
    shape.gradients << table_.dx.row(0), table_.dy.row(0);
    return true;
  }

  SampleRandom random_{GetParam()};
  MeanValueFarFromBoundary far_;
  ShapeTable table_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, MeanValueFar, testing::Values(3, 4, 5, 6, 8, 12, 20));

TEST_P(MeanValueFar, AgreesWithTheFormulaInManyDigitsOnMostOfAPolygon) {
  int n_far = 0, n_points = 0;
  ShapeValues shape, exact;
  for (const double offset : {0., 1e6})
    for (int trial = 0; trial < 20; ++trial) {
      Points polygon =
          trial % 2 == 0 ? convex_sample(GetParam(), random_) : star_sample(std::max(GetParam(), 5), random_);
      if (!far_.set(polygon)) continue;
      polygon.colwise() += Vec2(offset, -offset);
      const Points points = inner_points(polygon, 20);
      for (Index q = 0; q < points.cols(); ++q, ++n_points) {
        if (!is_far(polygon, points.col(q), shape)) continue;
        ++n_far;
        exact_mean_value(polygon, points.col(q), exact);
        ASSERT_LT((shape.values - exact.values).cwiseAbs().maxCoeff(), 1e-14);
        ASSERT_LT((shape.gradients - exact.gradients).cwiseAbs().maxCoeff(),
                  1e-14 * exact.gradients.cwiseAbs().maxCoeff());
      }
    }
  EXPECT_GT(n_points, 0);
  EXPECT_GT(n_far, n_points / 2);
}

TEST_P(MeanValueFar, LeavesPointsNearVerticesAndEdgesToTheOtherForm) {
  const Points polygon = star_sample(std::max(GetParam(), 5), random_);
  const Index n = polygon.cols();
  ShapeValues shape;
  for (Index i = 0; i < n; ++i) {
    const Vec2 a = polygon.col(i), edge = polygon.col((i + 1) % n) - a, inward(-edge.y(), edge.x());
    EXPECT_FALSE(is_far(polygon, a, shape));
    EXPECT_FALSE(is_far(polygon, a + 0.5 * edge, shape));
    for (const double away : {1e-12, 1e-6, 1e-3, 1e-2}) {
      EXPECT_FALSE(is_far(polygon, a + away * inward, shape));
      EXPECT_FALSE(is_far(polygon, a + 0.5 * edge + away * inward, shape));
    }
  }
}

TEST_P(MeanValueFar, IsNotForPolygonsWithAShortEdge) {
  const Points polygon = convex_sample(GetParam(), random_);
  Points with_short_edge(2, polygon.cols() + 1);
  with_short_edge << polygon, polygon.rightCols<1>() + 1e-3 * (polygon.col(0) - polygon.rightCols<1>());
  EXPECT_FALSE(far_.set(with_short_edge));
}

}  // namespace
