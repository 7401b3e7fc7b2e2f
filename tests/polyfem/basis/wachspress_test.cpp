// What Wachspress functions hold to fewer roundings, and at harder points, than the suite in testing/ demands
// of every basis.
#include <polyfem/basis/wachspress.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <limits>

using namespace polyfem;

namespace {

/// Random polygons of sizes 1e-6 to 1e6 at distances up to 1e8 sizes. Far away their vertices are rounded to
/// the coordinates' grid: all properties are those of the rounded polygon.
void for_each_polygon(int n, const std::function<void(const Points& polygon, double size)>& check) {
  std::mt19937 random(static_cast<unsigned>(n));
  for (const double size : {1e-6, 1., 1e6})
    for (const double distance : {0., 1., 1e4, 1e8})
      for (int trial = 0; trial < 20; ++trial) {
        const Vec2 offset = distance * size * support::random_direction(random);
        SCOPED_TRACE(testing::Message()
                     << "size " << size << ", distance " << distance << ", trial " << trial);
        check((size * support::random_convex_polygon(n, random)).colwise() + offset, size);
      }
}

/// A point of a polygon, rounded like its vertices, and the size the polygon had before it was moved away.
struct Sample {
  const Points& polygon;
  Vec2 x;
  double size;
};

/// Points inside, on an edge, close to a vertex and at it, of each of the polygons.
void for_each_sample(int n, const std::function<void(const Sample&)>& check) {
  std::mt19937 random(static_cast<unsigned>(n));
  for_each_polygon(n, [&](const Points& polygon, double size) {
    const int k = std::uniform_int_distribution<int>(0, n - 1)(random);
    const Vec2 a = polygon.col(k), b = polygon.col((k + 1) % n);
    for (int i = 0; i < 3; ++i) check({polygon, support::random_point_in(polygon, random), size});
    for (const double s : {0., 1e-9, 0.3, 0.5}) check({polygon, a + s * (b - a), size});
  });
}

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double largest(const Points& gradients) {
  return gradients.cwiseAbs().maxCoeff();
}

class Wachspress : public testing::TestWithParam<int> {
 protected:
  /// Of the sum of n gradients, each with round-off relative to the largest.
  double gradient_sum_tolerance() const { return 5e-15 + 4e-16 * GetParam(); }
  ShapeValues shape_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, Wachspress, testing::Values(3, 4, 5, 6, 7, 8, 12, 20, 50, 100));

TEST_P(Wachspress, ReproducesLinearFunctionsToAFewRoundings) {
  for_each_sample(GetParam(), [&](const Sample& sample) {
    wachspress(sample.polygon, sample.x, shape_);
    const Points from_x = sample.polygon.colwise() - sample.x;
    const double scale = largest(shape_.gradients);
    ASSERT_NEAR(shape_.values.sum(), 1, 1e-14);  // n roundings of numbers that sum to 1; measured: 2e-15
    ASSERT_LT((from_x * shape_.values).norm(), 4e-15 * sample.size);  // measured: 6e-16
    ASSERT_LT(shape_.gradients.rowwise().sum().norm(), gradient_sum_tolerance() * scale);
    ASSERT_LT((from_x * shape_.gradients.transpose() - Mat2::Identity()).norm(),
              gradient_sum_tolerance() * scale * sample.size);
  });
}

TEST_P(Wachspress, IsNotNegative) {
  for_each_sample(GetParam(), [&](const Sample& sample) {
    wachspress(sample.polygon, sample.x, shape_);
    // x itself may have been rounded out of the polygon by an ulp of its coordinates
    const double step = epsilon * (sample.x.norm() + sample.size);
    ASSERT_GT(shape_.values.minCoeff(), -2 * step * largest(shape_.gradients));
  });
}

TEST_P(Wachspress, IsOneAtItsVertexAndZeroAtTheOthers) {
  for_each_polygon(GetParam(), [&](const Points& polygon, double) {
    for (Index i = 0; i < GetParam(); ++i) {
      wachspress(polygon, polygon.col(i), shape_);
      ASSERT_NEAR(shape_.values[i], 1, epsilon);
      ASSERT_EQ((shape_.values.array() != 0).count(), 1);
    }
  });
}

TEST_P(Wachspress, GradientAtAVertexIsThatOfTheTriangleOfItsCorner) {
  const Index n = GetParam();
  for_each_polygon(GetParam(), [&](const Points& polygon, double) {
    for (Index i = 0; i < n; ++i) {
      const Index before = (i + n - 1) % n, after = (i + 1) % n;
      const Vec2 in = polygon.col(before) - polygon.col(i);
      const Vec2 out = polygon.col(after) - polygon.col(i);
      Points expected = Points::Zero(2, n);
      expected.col(before) = Vec2(-out.y(), out.x()) / cross(out, in);
      expected.col(after) = Vec2(-in.y(), in.x()) / cross(in, out);
      expected.col(i) = -expected.col(before) - expected.col(after);
      wachspress(polygon, polygon.col(i), shape_);
      ASSERT_LT(largest(shape_.gradients - expected), 1e-14 * largest(expected));
    }
  });
}

TEST_P(Wachspress, IsLinearAlongEdges) {
  const Index n = GetParam();
  for_each_polygon(GetParam(), [&](const Points& polygon, double size) {
    for (Index k = 0; k < n; ++k) {
      const Vec2 a = polygon.col(k), edge = polygon.col((k + 1) % n) - a;
      for (const double s : {1e-12, 0.2, 0.5, 0.9}) {
        VectorXd expected = (1 - s) * VectorXd::Unit(n, k) + s * VectorXd::Unit(n, (k + 1) % n);
        wachspress(polygon, a + s * edge, shape_);
        ASSERT_TRUE(shape_.gradients.allFinite());
        // the point is on the edge but for the rounding of its coordinates
        const double step = epsilon * ((a + s * edge).norm() + size);
        const double scale = largest(shape_.gradients);
        ASSERT_LT((shape_.values - expected).cwiseAbs().maxCoeff(), 4 * step * scale);

        expected = VectorXd::Unit(n, (k + 1) % n) - VectorXd::Unit(n, k);
        const VectorXd along = shape_.gradients.transpose() * edge;
        // of second derivatives, which are of the order of the square of the gradients, over that distance
        const double tolerance = gradient_sum_tolerance() + 4 * step * scale;
        ASSERT_LT((along - expected).cwiseAbs().maxCoeff(), tolerance * scale * edge.norm() * 4);
      }
    }
  });
}

}  // namespace
