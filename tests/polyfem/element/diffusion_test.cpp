#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/diffusion.hpp>
#include <polyfem/element/matrices.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

using namespace polyfem;

namespace {

Mat2 anisotropic() {
  Mat2 k;
  k << 3, 0.5, 0.5, 2;
  return k;
}

class Diffusion : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { tabulate(polygon_, hammer_rule(3), wachspress, GradientCorrection::on, element_); }
  int n_ = GetParam();
  std::mt19937 random_{static_cast<unsigned>(n_)};
  Points polygon_ = support::random_convex_polygon(n_, random_);
  TabulatedElement element_;
  MatrixXd K_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, Diffusion, testing::Values(3, 4, 5, 6, 8, 12, 20));

TEST_P(Diffusion, IsTheSumOfProductsOfGradients) {
  MatrixXd expected = MatrixXd::Zero(n_, n_);
  for (Index q = 0; q < element_.n_points(); ++q) {
    Points gradients(2, n_);
    gradients << element_.dx.row(q), element_.dy.row(q);
    expected += element_.rule.weights[q] * gradients.transpose() * anisotropic() * gradients;
  }
  diffusion(element_, anisotropic(), K_);
  EXPECT_TRUE(K_.isApprox(expected, 1e-14));
  EXPECT_EQ(K_, K_.transpose());
}

TEST_P(Diffusion, FluxOfALinearPotentialLeavesThroughTheBoundary) {
  const Vec2 gradient(0.3, -0.7);
  const VectorXd u = polygon_.transpose() * gradient;
  VectorXd flux = VectorXd::Zero(n_);  // k grad u . n, half of each edge's to each end
  for (Index k = 0; k < n_; ++k) {
    const Index next = (k + 1) % n_;
    const Vec2 edge = polygon_.col(next) - polygon_.col(k);
    const double through = (anisotropic() * gradient).dot(Vec2(edge.y(), -edge.x()));
    flux[k] += through / 2;
    flux[next] += through / 2;
  }
  diffusion(element_, anisotropic(), K_);
  EXPECT_LT((K_ * u - flux).norm(), 1e-14 * K_.norm() * u.norm());
}

TEST_P(Diffusion, OnlyAConstantPotentialMeetsNoResistance) {
  diffusion(element_, anisotropic(), K_);
  const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(K_).eigenvalues();
  EXPECT_LT(std::abs(values[0]), 1e-14 * values[n_ - 1]);
  EXPECT_GT(values[1], 1e-3 * values[n_ - 1]);
  EXPECT_LT((K_ * VectorXd::Ones(n_)).norm(), 1e-14 * K_.norm() * n_);
}

TEST_P(Diffusion, ScalarMassIsThatOfOneDirection) {
  MatrixXd scalar, both;
  scalar_mass(element_, scalar);
  mass(element_, both);
  EXPECT_EQ(scalar, scalar.transpose());
  EXPECT_NEAR(scalar.sum(), element_.area, 1e-14);
  for (Index axis = 0; axis < 2; ++axis)
    EXPECT_EQ(scalar, both(Eigen::seqN(axis, n_, 2), Eigen::seqN(axis, n_, 2)));
}

TEST_P(Diffusion, LumpedMassIsPositiveAndKeepsTheCentreOfMass) {
  const AreaMoments moments = area_moments(polygon_);
  for (int degree = 1; degree <= 5; ++degree) {
    tabulate(polygon_, hammer_rule(degree), wachspress, GradientCorrection::on, element_);
    VectorXd m;
    lumped_mass(element_, m);
    EXPECT_GT(m.minCoeff(), 0);
    EXPECT_NEAR(m.sum(), moments.area, 1e-14);
    EXPECT_LT((polygon_ * m - moments.area * moments.centroid).norm(), 1e-14);
  }
}

TEST(DiffusionInATriangle, IsThatOfLinearFunctions) {
  std::mt19937 random(1);
  const Points triangle = support::random_convex_polygon(3, random);
  TabulatedElement element;
  tabulate(triangle, hammer_rule(3), wachspress, GradientCorrection::on, element);
  const auto side = [&](Index k) { return Vec2(triangle.col((k + 2) % 3) - triangle.col((k + 1) % 3)); };
  MatrixXd expected(3, 3), K;
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) expected(i, j) = side(i).dot(side(j)) / (4 * element.area);
  diffusion(element, Mat2::Identity(), K);
  EXPECT_TRUE(K.isApprox(expected, 1e-13));
}

TEST(LumpedMass, OfASquareIsAQuarterEach) {
  Points square(2, 4);
  square << 0, 1, 1, 0,  //
      0, 0, 1, 1;
  TabulatedElement element;
  tabulate(square, hammer_rule(3), wachspress, GradientCorrection::on, element);
  VectorXd m;
  lumped_mass(element, m);
  EXPECT_LT((m - VectorXd::Constant(4, 0.25)).norm(), 1e-15);
}

/// An outline with thin arms, star-shaped about the origin, integrated by triangles from there.
TEST(LumpedMass, StaysPositiveWhereAShapeFunctionIsNegativeOnAverage) {
  Points arms(2, 8);
  arms << 0.38, 0.006, 0.08, 0.15, 0.008, -0.31, -0.015, 0.47,  //
      0.81, 0.021, 0.3, 0.7, 0.079, -0.024, -0.004, -0.17;
  const TriangleRule triangle_rule = collapsed_gauss_rule(12, 12, 2);
  PolygonRule rule{Points(2, 8 * 144), VectorXd(8 * 144)};
  for (Index k = 0; k < 8; ++k) {
    const Vec2 a = arms.col(k), b = arms.col((k + 1) % 8);
    rule.weights.segment(144 * k, 144) = cross(a, b) / 2 * triangle_rule.weights;
    rule.points.middleCols(144 * k, 144) = a * triangle_rule.points.row(1) + b * triangle_rule.points.row(2);
  }
  TabulatedElement element;
  tabulate(arms, rule, mean_value, GradientCorrection::on, element);
  VectorXd m, row_sums;
  shape_integrals(element, row_sums);
  EXPECT_LT(row_sums.minCoeff(), -0.01 * element.area);
  lumped_mass(element, m);
  EXPECT_GT(m.minCoeff(), 0);
  EXPECT_NEAR(m.sum(), element.area, 1e-15);
}

}  // namespace
