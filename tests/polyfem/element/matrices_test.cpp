#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

class ElementMatrices : public testing::TestWithParam<int> {
 protected:
  void tabulate_with(const TriangleRule& rule, const Points& polygon) {
    tabulate(polygon, rule, wachspress, GradientCorrection::on, element_);
  }
  VectorXd random_displacements() {
    VectorXd d(2 * n_);
    for (double& value : d) value = support::uniform(-1, 1, random_);
    return d;
  }
  /// The values of the field u = a + G x at the vertices.
  VectorXd linear_field(const Vec2& a, const Mat2& G, const Points& polygon) const {
    const Points u = (G * polygon).colwise() + a;
    return Eigen::Map<const VectorXd>(u.data(), 2 * n_);
  }

  int n_ = GetParam();
  std::mt19937 random_{static_cast<unsigned>(n_)};
  Points polygon_ = support::random_convex_polygon(n_, random_);
  Mat3 D_ = elasticity_matrix(1, 0.3, Plane::strain);
  TabulatedElement element_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, ElementMatrices, testing::Values(3, 4, 5, 6, 8, 12, 20));

TEST_P(ElementMatrices, StiffnessIsTheSumOfTransposedBTimesDTimesB) {
  Mat3 anisotropic;            // all nine entries differ from zero: every product of the fast path counts
  anisotropic << 3, 0.7, 0.2,  //
      0.7, 2, 0.4,             //
      0.2, 0.4, 1;
  tabulate_with(hammer_rule(3), polygon_);
  MatrixXd expected = MatrixXd::Zero(2 * n_, 2 * n_), K;
  for (Index q = 0; q < element_.n_points(); ++q) {
    MatrixXd B = MatrixXd::Zero(3, 2 * n_);  // Eq. (8)
    for (Index i = 0; i < n_; ++i) {
      B(0, 2 * i) = B(2, 2 * i + 1) = element_.dx(q, i);
      B(1, 2 * i + 1) = B(2, 2 * i) = element_.dy(q, i);
    }
    expected += element_.rule.weights[q] * B.transpose() * anisotropic * B;
  }
  stiffness(element_, anisotropic, K);
  EXPECT_TRUE(K.isApprox(expected, 1e-14));
  EXPECT_EQ(K, K.transpose());
}

TEST_P(ElementMatrices, StiffnessDoesNotDependOnSizeAndPlace) {
  MatrixXd K, moved;
  tabulate_with(hammer_rule(4), polygon_);
  stiffness(element_, D_, K);
  for (const double size : {1e-6, 1e6}) {
    tabulate_with(hammer_rule(4), (size * polygon_).colwise() + Vec2(3 * size, -5 * size));
    stiffness(element_, D_, moved);
    EXPECT_TRUE(moved.isApprox(K, 1e-13));  // vertices rounded at 5 sizes, over edges of a tenth of it
  }
}

TEST_P(ElementMatrices, StiffnessTurnsWithThePolygon) {
  const double angle = 0.7;
  Mat2 R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  MatrixXd K, turned, rotation = MatrixXd::Zero(2 * n_, 2 * n_);
  for (Index i = 0; i < n_; ++i) rotation.block<2, 2>(2 * i, 2 * i) = R;
  tabulate_with(hammer_rule(4), polygon_);
  stiffness(element_, D_, K);
  tabulate_with(hammer_rule(4), R * polygon_);
  stiffness(element_, D_, turned);
  EXPECT_TRUE(turned.isApprox(rotation * K * rotation.transpose(), 1e-13));
}

TEST_P(ElementMatrices, MassSumsToTheAreaInEachDirectionAndCouplesNone) {
  tabulate_with(hammer_rule(3), polygon_);
  MatrixXd M;
  mass(element_, M);
  EXPECT_EQ(M, M.transpose());
  for (Index a = 0; a < 2; ++a)
    for (Index b = 0; b < 2; ++b) {
      double sum = 0;
      for (Index i = a; i < 2 * n_; i += 2)
        for (Index j = b; j < 2 * n_; j += 2) sum += M(i, j);
      EXPECT_NEAR(sum, a == b ? element_.area : 0, 1e-13);
    }
}

TEST_P(ElementMatrices, MassGivesTheMomentumOfRigidMotionExactly) {
  tabulate_with(hammer_rule(2), polygon_);
  MatrixXd M;
  mass(element_, M);
  const AreaMoments moments = area_moments(polygon_);
  Mat2 rotation;
  rotation << 0, -1, 1, 0;
  const VectorXd spin = linear_field(-rotation * moments.centroid, rotation, polygon_);
  EXPECT_NEAR(spin.dot(M * spin), moments.second.trace(), 1e-13);  // the polar moment
  for (int axis = 0; axis < 2; ++axis) {
    const VectorXd shift = linear_field(Vec2::Unit(axis), Mat2::Zero(), polygon_);
    EXPECT_NEAR(shift.dot(M * shift), moments.area, 1e-13);
    EXPECT_NEAR(shift.dot(M * spin), 0, 1e-13);
  }
}

TEST_P(ElementMatrices, MassScalesWithTheSquareOfTheSize) {
  MatrixXd M, scaled;
  tabulate_with(hammer_rule(4), polygon_);
  mass(element_, M);
  tabulate_with(hammer_rule(4), 1e3 * polygon_);
  mass(element_, scaled);
  EXPECT_TRUE(scaled.isApprox(1e6 * M, 1e-13));
}

TEST_P(ElementMatrices, ShapeIntegralsAreTheRowSumsOfTheMassAndBalanceTheWeight) {
  tabulate_with(hammer_rule(3), polygon_);
  MatrixXd M;
  VectorXd integrals;
  mass(element_, M);
  shape_integrals(element_, integrals);
  ASSERT_EQ(integrals.size(), n_);
  for (Index i = 0; i < n_; ++i) {
    double row_sum = 0;
    for (Index j = 0; j < n_; ++j) row_sum += M(2 * i, 2 * j);
    EXPECT_NEAR(integrals[i], row_sum, 1e-14);
  }
  const AreaMoments moments = area_moments(polygon_);
  EXPECT_NEAR(integrals.sum(), moments.area, 1e-14);
  EXPECT_LT((polygon_ * integrals - moments.area * moments.centroid).norm(), 1e-14);
}

TEST_P(ElementMatrices, StressForcesOfElasticStressAreStiffnessTimesDisplacement) {
  tabulate_with(hammer_rule(3), polygon_);
  const VectorXd d = random_displacements();
  MatrixXd K;
  Tensors strain;
  VectorXd f(2 * n_);
  stiffness(element_, D_, K);
  strains(element_, d, strain);
  stress_forces(element_, D_ * strain, f);
  EXPECT_LT((f - K * d).norm(), 1e-14 * K.norm() * d.norm());
}

TEST_P(ElementMatrices, StressForcesDoTheWorkOfTheStressOnAnyStrain) {
  tabulate_with(hammer_rule(5), polygon_);
  const VectorXd d = random_displacements();
  Tensors stress = Tensors::Random(3, element_.n_points()), strain;
  VectorXd f(2 * n_);
  strains(element_, d, strain);
  stress_forces(element_, stress, f);
  const double work = (stress.cwiseProduct(strain) * element_.rule.weights).sum();
  EXPECT_NEAR(f.dot(d), work, 1e-13 * f.norm() * d.norm());
}

}  // namespace
