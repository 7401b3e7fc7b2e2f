#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/stress_recovery.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

class StressRecovery : public testing::TestWithParam<int> {
 protected:
  int n_ = GetParam();
  std::mt19937 random_{static_cast<unsigned>(n_)};
  Points polygon_ = support::random_convex_polygon(n_, random_);
  TabulatedElement element_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, StressRecovery, testing::Values(3, 4, 5, 6, 8, 12));

TEST_P(StressRecovery, StrainAtAPointIsThatOfTheElementThere) {
  tabulate(polygon_, hammer_rule(3), wachspress, GradientCorrection::off, element_);
  const VectorXd d = VectorXd::Random(2 * n_);
  Tensors strain;
  strains(element_, d, strain);
  for (Index q = 0; q < element_.n_points(); ++q)
    EXPECT_LT((strain_at(polygon_, wachspress, d, element_.rule.points.col(q)) - strain.col(q)).norm(),
              1e-13 * strain.norm());
}

TEST_P(StressRecovery, StrainOfALinearFieldIsExactAtVerticesToo) {
  Mat2 G;
  G << 0.3, -0.2, 0.5, 0.1;
  const VectorXd d = (G * polygon_).reshaped();
  for (Index i = 0; i < n_; ++i)
    EXPECT_LT((strain_at(polygon_, wachspress, d, polygon_.col(i)) - Vec3(0.3, 0.1, 0.3)).norm(), 1e-12);
}

TEST_P(StressRecovery, LinearStressesAreExactAtTheVerticesAtAnyPlace) {
  Eigen::Matrix<double, 3, 2> slope;
  slope << 1, 2, -3, 0.5, 0, 4;
  const Vec3 at_origin(7, -2, 1);
  for (const double offset : {0., 1e3, 1e6})
    for (int degree = 2; degree <= 5; ++degree) {
      const Points place = polygon_.array() + offset;
      tabulate(place, hammer_rule(degree), wachspress, GradientCorrection::on, element_);
      const auto field = [&](const Points& x) {
        return Tensors((slope * (x.array() - offset).matrix()).colwise() + at_origin);
      };
      MatrixXd at_vertices;
      extrapolate_to_vertices(place, element_, field(element_.rule.points), at_vertices);
      EXPECT_LT((at_vertices - field(place)).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST_P(StressRecovery, NearestLinearFieldKeepsMeanAndFirstMoments) {
  tabulate(polygon_, hammer_rule(5), wachspress, GradientCorrection::on, element_);
  const MatrixXd values = MatrixXd::Random(2, element_.n_points());
  MatrixXd at_vertices, again;
  extrapolate_to_vertices(polygon_, element_, values, at_vertices);
  // linear within the element: shape functions carry it to the points, and from there it comes back
  const MatrixXd linear = at_vertices * element_.values.transpose();
  const VectorXd& w = element_.rule.weights;
  EXPECT_LT(((values - linear) * w).norm(), 1e-13);
  EXPECT_LT(((values - linear) * w.asDiagonal() * element_.rule.points.transpose()).norm(), 1e-13);
  extrapolate_to_vertices(polygon_, element_, linear, again);
  EXPECT_LT((again - at_vertices).norm(), 1e-12 * at_vertices.norm());
}

TEST(StressRecoveryFromFewPoints, OfASinglePointEveryVertexHasTheValue) {
  Points triangle(2, 3);
  triangle << 0.1, 1.3, 0.4,  //
      0.2, 0.7, 1.9;
  TabulatedElement element;
  const PolygonRule rule{triangle.rowwise().mean(), VectorXd::Constant(1, 0.945)};
  tabulate(triangle, rule, wachspress, GradientCorrection::on, element);
  const Vec3 stress(7, -2, 1);
  MatrixXd at_vertices;
  extrapolate_to_vertices(triangle, element, stress, at_vertices);
  EXPECT_LT((at_vertices.colwise() - stress).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(StressRecoveryFromFewPoints, IsConstantAcrossTheLineOfTwo) {
  Points quadrilateral(2, 4);
  quadrilateral << 0, 1, 0.7, -0.1,  //
      0.1, 0, 1.1, 0.9;
  const PolygonRule rule{(Points(2, 2) << 0.3, 0.5, 0.4, 0.6).finished(), Vec2(0.5, 0.3)};
  TabulatedElement element;
  tabulate(quadrilateral, rule, wachspress, GradientCorrection::on, element);
  const Vec2 along(3, 3);
  MatrixXd at_vertices;
  extrapolate_to_vertices(quadrilateral, element, along.transpose() * rule.points, at_vertices);
  EXPECT_LT((at_vertices - along.transpose() * quadrilateral).cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
