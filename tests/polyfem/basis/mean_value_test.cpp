// What is particular to mean value functions; what they share with all bases is in testing/.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/mean_value_at_vertex.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/testing/sample_polygons.hpp>
#include <tests/polyfem/basis/exact_mean_value.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

using namespace polyfem;

namespace {

double largest(const Points& gradients) {
  return gradients.cwiseAbs().maxCoeff();
}

/// Convex, with every other vertex on an edge, concave; unit size.
std::vector<Points> polygons(int n, SampleRandom& random) {
  std::vector<Points> result{convex_sample(n, random), star_sample(std::max(n, 5), random)};
  if (n <= 50) result.push_back(with_middle_vertices(convex_sample(n, random)));
  return result;
}

class MeanValue : public testing::TestWithParam<int> {
 protected:
  SampleRandom random_{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Vertices, MeanValue, testing::Values(3, 4, 5, 6, 8, 12, 20, 50, 100));

/// Places along an edge and distances from it are drawn over all magnitudes.
TEST_P(MeanValue, AgreesWithItsFormulaInManyDigitsUpToTheBoundary) {
  ShapeValues shape, exact;
  for (const double size : {1e-6, 1., 1e6})
    for (const double offset : {0., 1., 1e4, 1e8})
      for (const Points& unit : polygons(GetParam(), random_)) {
        const Points polygon = (size * unit).colwise() + offset * size * Vec2(0.6, -0.8);
        for (int trial = 0; trial < 5; ++trial) {
          const Index n = polygon.cols(), k = static_cast<Index>(random_(0, static_cast<double>(n)));
          const Vec2 a = polygon.col(k), edge = polygon.col((k + 1) % n) - a;
          const double along = trial % 2 == 0 ? random_(0.1, 1) : std::pow(10, random_(-15, 0));
          const double away = trial < 2 ? 0 : std::pow(10, random_(-16, -0.5));
          const Vec2 x = a + along * edge + away * Vec2(-edge.y(), edge.x());
          if ((polygon.colwise() - x).colwise().norm().minCoeff() == 0) continue;  // rounded to the vertex
          if (away > 1e-12 && !contains(polygon, x)) continue;
          mean_value(polygon, x, shape);
          exact_mean_value(polygon, x, exact);
          const double value = (shape.values - exact.values).cwiseAbs().maxCoeff();
          const double gradient = largest(shape.gradients - exact.gradients) / largest(exact.gradients);
          ASSERT_LT(value, 1e-14) << "edge " << k << ", " << along << " along it, " << away << " from it";
          ASSERT_LT(gradient, 1e-14) << "edge " << k << ", " << along << " along it, " << away << " from it";
        }
      }
}

TEST_P(MeanValue, IsPositiveInConvexPolygons) {
  ShapeTable table;
  for (const Points& polygon : {convex_sample(GetParam(), random_),  //
                                with_middle_vertices(convex_sample(GetParam(), random_))}) {
    mean_value.evaluate(polygon, inner_points(polygon, 100), table);
    EXPECT_GT(table.values.minCoeff(), 0);
  }
}

TEST_P(MeanValue, OfARegularPolygonIsEqualAtTheCentre) {
  const int n = GetParam();
  ShapeValues shape;
  const Points polygon = support::regular_polygon(n);
  mean_value(polygon, Vec2::Zero(), shape);
  EXPECT_LT((shape.values.array() - 1. / n).abs().maxCoeff(), 1e-15);
  // by symmetry grad N_i points to v_i, and sum v_i grad N_i^T = I makes its length 2 / n
  EXPECT_LT(largest(shape.gradients - 2. / n * polygon), 2e-14 / n);
}

TEST_P(MeanValue, GradientAtAVertexHasTheSlopesOfBothEdges) {
  ShapeValues shape;
  const Points polygon = star_sample(std::max(GetParam(), 5), random_);
  const Index n = polygon.cols();
  for (Index i = 0; i < n; ++i) {
    mean_value(polygon, polygon.col(i), shape);
    for (const Index k : {(i + n - 1) % n, i}) {
      const Index next = (k + 1) % n;
      const Vec2 edge = polygon.col(next) - polygon.col(k);
      const VectorXd slopes = shape.gradients.transpose() * edge;
      EXPECT_LT((slopes - VectorXd::Unit(n, next) + VectorXd::Unit(n, k)).cwiseAbs().maxCoeff(),
                1e-14 * largest(shape.gradients) * edge.norm());
    }
  }
}

class MeanValueAtAStraightCorner : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Turn, MeanValueAtAStraightCorner, testing::Values(-9e-4, -1e-6, 0, 1e-12, 1e-4));

TEST_P(MeanValueAtAStraightCorner, IsTheLimitAlongTheBisector) {
  Points polygon(2, 6);
  polygon << 0, 0.5, 2, 2.2, 0.6, -0.1,  //
      0, -0.375 * GetParam(), 0, 1, 1.3, 1;
  ShapeValues at, near;
  mean_value(polygon, polygon.col(1), at);
  const Vec2 in = polygon.col(1) - polygon.col(0), out = polygon.col(2) - polygon.col(1);
  const Vec2 tangent = in.normalized() + out.normalized(),
             bisector = Vec2(-tangent.y(), tangent.x()).normalized();
  EXPECT_EQ(at.values, VectorXd::Unit(6, 1));
  for (const double distance : {1e-3, 1e-5, 1e-7}) {
    mean_value(polygon, polygon.col(1) + distance * bisector, near);
    EXPECT_LT(largest(near.gradients - at.gradients), 20 * distance);
  }
  // the mean of the slopes of both edges
  const VectorXd slopes = at.gradients.transpose() * tangent.normalized();
  EXPECT_NEAR(slopes[2], 0.5 / out.norm(), 1e-3);
  EXPECT_NEAR(slopes[0], -0.5 / in.norm(), 1e-3);
}

/// A triangle and a hexagon in no particular direction, by their thinness.
class MeanValueInANeedle : public testing::TestWithParam<double> {
 protected:
  Points triangle() const {
    Points polygon(2, 3);
    polygon << 0, 1, 1,  //
        0, 0.3, 0.3 + GetParam();
    return polygon;
  }
  Points hexagon() const {
    const Mat2 turned = Eigen::Rotation2Dd(0.7).toRotationMatrix();
    return turned * Vec2(1, GetParam()).asDiagonal() * support::regular_polygon(6);
  }
};
INSTANTIATE_TEST_SUITE_P(Thinness, MeanValueInANeedle, testing::Values(1e-3, 1e-6, 1e-9));

TEST_P(MeanValueInANeedle, AgreesWithItsFormulaInManyDigits) {
  SampleRandom random(3);
  ShapeValues shape, exact;
  for (const Points& polygon : {triangle(), hexagon()})
    for (int trial = 0; trial < 40; ++trial) {
      VectorXd weights(polygon.cols());
      for (double& weight : weights) weight = std::pow(random(0, 1), trial % 2 == 0 ? 1 : 12);
      const Vec2 x = polygon * weights / weights.sum();
      mean_value(polygon, x, shape);
      exact_mean_value(polygon, x, exact);
      EXPECT_LT((shape.values - exact.values).cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_LT(largest(shape.gradients - exact.gradients), 1e-14 * largest(exact.gradients));
    }
}

TEST_P(MeanValueInANeedle, HasTheLinearGradientsAtTheVerticesOfATriangle) {
  ShapeValues at, inside;
  const Points polygon = triangle();
  exact_mean_value(polygon, polygon.rowwise().mean(), inside);
  for (Index i = 0; i < 3; ++i) {
    mean_value(polygon, polygon.col(i), at);
    EXPECT_LT(largest(at.gradients - inside.gradients), 1e-14 * largest(inside.gradients));
  }
}

TEST(MeanValueFunctions, WriteNothingButTheirTableWhateverTheInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Points collinear(2, 3), larger = support::regular_polygon(50);
  collinear << 0, 1, 2,  //
      0, 0, 0;
  for (const Vec2& x : {Vec2(0.5, 0), Vec2(nan, 0), Vec2(nan, nan)}) {
    ShapeTable table;
    mean_value.evaluate(larger, 0.9 * larger, table);  // the last point is nearest to vertex 49
    mean_value.evaluate(collinear, x.replicate(1, 5), table);
    EXPECT_EQ(table.n_points(), 5);
    EXPECT_FALSE(table.values.allFinite());
  }
}

TEST(MeanValueFunctions, HaveTheirBoundedGradientsAtAnyDistanceFromAVertex) {
  Points polygon(2, 5);
  polygon << 0, 1, 1, 0, 0,  //
      0, 0, 1, 1, 0.5;
  ShapeValues reference, shape;
  mean_value(polygon, Vec2(2e-20, 1e-20), reference);
  for (const double distance : {1e-60, 1e-100, 1e-139}) {
    mean_value(polygon, distance * Vec2(2, 1), shape);
    EXPECT_LT(largest(shape.gradients - reference.gradients), 1e-14);
  }
  for (const double distance : {1e-141, 1e-200, 1e-320}) {  // so near counts as at the vertex
    mean_value(polygon, distance * Vec2(2, 1), shape);
    EXPECT_EQ(shape.values, VectorXd::Unit(5, 0));
  }
}

TEST(MeanValueFunctions, AreNegativeWhereAConcaveCornerHidesTheVertex) {
  const std::vector<SamplePolygon> concave = concave_samples();
  const auto least = [](const Points& polygon) {
    ShapeTable table;
    mean_value.evaluate(polygon, inner_points(polygon, 500), table);
    return table.values.minCoeff();
  };
  EXPECT_NEAR(least(concave[1].vertices), -0.01, 0.005);  // L
  EXPECT_LT(least(concave[2].vertices), -0.1);            // deep notch
}

TEST(MeanValueFunctions, ObjectToARepeatedVertexAlone) {
  Points polygon(2, 5);
  polygon << 0, 1, 1, 1, 0,  //
      0, 0, 1, 1, 1;
  const auto rejection = mean_value.find_rejection(polygon);
  ASSERT_TRUE(rejection);
  EXPECT_EQ(rejection->vertex, 2);
  EXPECT_THROW(require_suitable(mean_value, polygon), Error);
  for (const SamplePolygon& concave : concave_samples())
    EXPECT_FALSE(mean_value.find_rejection(concave.vertices)) << concave.name;
}

}  // namespace
