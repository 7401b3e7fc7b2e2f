// The patch test of one element: under a linear displacement field its nodal forces are those of the constant
// stress on its boundary.
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/direct_mean_value.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>

using namespace polyfem;

namespace {

/// Nodal forces of a constant stress: on each edge the traction sigma n, half to each end.
VectorXd boundary_forces(const Points& polygon, const Vec3& stress) {
  Mat2 sigma;
  sigma << stress[0], stress[2], stress[2], stress[1];
  VectorXd f = VectorXd::Zero(2 * polygon.cols());
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Index next = (k + 1) % polygon.cols();
    const Vec2 edge = polygon.col(next) - polygon.col(k);
    const Vec2 force = sigma * Vec2(edge.y(), -edge.x());
    f.segment<2>(2 * k) += force / 2;
    f.segment<2>(2 * next) += force / 2;
  }
  return f;
}

/// The largest error of the nodal forces over three independent fields, relative to the largest force.
double patch_residual(const Points& polygon, const TriangleRule& rule, GradientCorrection correction,
                      const Basis& basis = wachspress) {
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  TabulatedElement element;
  MatrixXd K;
  tabulate(polygon, rule, basis, correction, element);
  stiffness(element, D, K);
  Mat2 gradients[3];
  gradients[0] << 1, 0, 0, 0;
  gradients[1] << 0, 0, 0, 1;
  gradients[2] << 0, 0.3, 0.7, 0;
  double worst = 0;
  for (const Mat2& G : gradients) {
    const Points u = G * polygon;
    const VectorXd d = Eigen::Map<const VectorXd>(u.data(), u.size());
    const VectorXd exact = boundary_forces(polygon, D * Vec3(G(0, 0), G(1, 1), G(0, 1) + G(1, 0)));
    worst = std::max(worst, (K * d - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff());
  }
  return worst;
}

class PatchTest : public testing::TestWithParam<int> {
 protected:
  std::mt19937 random_{static_cast<unsigned>(GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Vertices, PatchTest, testing::Values(3, 4, 5, 6, 8, 10, 12, 20));

TEST_P(PatchTest, HoldsToRoundOffForAnyRuleWithTheCorrection) {
  double worst = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Points polygon = support::random_convex_polygon(GetParam(), random_);
    for (int degree = 1; degree <= 5; ++degree)
      worst = std::max(worst, patch_residual(polygon, hammer_rule(degree), GradientCorrection::on));
    worst = std::max(worst, patch_residual(polygon, collapsed_gauss_rule(6, 3, 2), GradientCorrection::on));
  }
  EXPECT_LT(worst, 1e-13);
  RecordProperty("worst_residual", testing::PrintToString(worst));
}

/// From four vertices on: the gradients of a triangle are constant and any rule is exact.
class PatchTestWithoutCorrection : public PatchTest {};
INSTANTIATE_TEST_SUITE_P(Vertices, PatchTestWithoutCorrection, testing::Values(4, 5, 6, 8));

TEST_P(PatchTestWithoutCorrection, FailsWithThePapersRule) {
  std::vector<double> residuals;
  for (int trial = 0; trial < 41; ++trial)
    residuals.push_back(patch_residual(support::random_convex_polygon(GetParam(), random_), hammer_rule(3),
                                       GradientCorrection::off));
  const auto median = residuals.begin() + 20;
  std::nth_element(residuals.begin(), median, residuals.end());
  EXPECT_GT(*median, 1e-4);
  RecordProperty("median_residual", testing::PrintToString(*median));
}

TEST_P(PatchTestWithoutCorrection, HoldsAsTheRuleConverges) {
  const Points polygon = support::random_convex_polygon(GetParam(), random_);
  EXPECT_LT(patch_residual(polygon, collapsed_gauss_rule(40, 40, 2), GradientCorrection::off), 1e-8);
}

/// Four points a triangle, of the fan or of the ears.
TEST(PatchTestOfConcavePolygons, HoldsToRoundOffWithTheCorrectionAndFailsWithout) {
  const support::DirectMeanValue mean_value;
  for (const auto& [name, polygon] : support::concave_polygons()) {
    const double corrected = patch_residual(polygon, hammer_rule(3), GradientCorrection::on, mean_value);
    const double raw = patch_residual(polygon, hammer_rule(3), GradientCorrection::off, mean_value);
    EXPECT_LT(corrected, 1e-12) << name;
    EXPECT_GT(raw, 1e-3) << name;
    RecordProperty(name + " raw", testing::PrintToString(raw));
  }
}

TEST(PatchTestOfRegularPolygons, HoldsBySymmetryAndIsNoEvidence) {
  for (const int n : {4, 6, 8})
    EXPECT_LT(patch_residual(support::regular_polygon(n), hammer_rule(3), GradientCorrection::off), 1e-13);
}

}  // namespace
