#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

using namespace polyfem;

namespace {

const Mat3 nearly_incompressible = elasticity_matrix(1, 0.499999, Plane::strain);

Mat3 anisotropic() {
  Mat3 D;
  D << 3, 0.7, 0.2,  //
      0.7, 2, 0.4,   //
      0.2, 0.4, 1;
  return D;
}

/// The displacements u = G x of the vertices.
VectorXd linear_field(const Mat2& G, const Points& polygon) {
  const Points u = G * polygon;
  return Eigen::Map<const VectorXd>(u.data(), u.size());
}

/// Eigenvalues in increasing order.
VectorXd eigenvalues(const MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

class BBar : public testing::TestWithParam<int> {
 protected:
  void tabulate_with(const TriangleRule& rule) {
    tabulate(polygon_, rule, wachspress, GradientCorrection::on, element_);
  }
  VectorXd random_displacements() {
    VectorXd d(2 * n_);
    for (double& value : d) value = support::uniform(-1, 1, random_);
    return d;
  }
  int n_ = GetParam();
  std::mt19937 random_{static_cast<unsigned>(n_)};
  Points polygon_ = support::random_convex_polygon(n_, random_);
  TabulatedElement element_;
  MatrixXd K_, plain_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, BBar, testing::Values(3, 4, 5, 6, 8, 12));

TEST_P(BBar, ResistsWithLambdaOnlyTheMeanDilatation) {
  tabulate_with(hammer_rule(5));
  for (const double poisson : {0., 0.3, 0.4999})
    for (const Plane plane : {Plane::strain, Plane::stress}) {
      const Mat3 D = elasticity_matrix(1, poisson, plane);
      const VectorXd d = random_displacements();
      Tensors strain;
      strains(element_, d, strain);
      const VectorXd& w = element_.rule.weights;
      const double theta = (strain.row(0) + strain.row(1)).dot(w) / w.sum(), lambda = D(0, 1), mu = D(2, 2);
      const double rest = mu * (Vec3(2, 2, 1).asDiagonal() * strain.cwiseAbs2() * w).sum();
      b_bar_stiffness(element_, D, K_);
      EXPECT_NEAR(d.dot(K_ * d) / (rest + lambda * theta * theta * w.sum()), 1, 1e-12);
      EXPECT_EQ(K_, K_.transpose());
    }
}

TEST_P(BBar, ForcesOfItsStressesAreItsStiffnessTimesDisplacement) {
  tabulate_with(hammer_rule(3));
  for (const Mat3& D : {anisotropic(), elasticity_matrix(1, 0.3, Plane::strain)}) {
    const VectorXd d = random_displacements();
    Tensors stress;
    VectorXd f(2 * n_);
    b_bar_stiffness(element_, D, K_);
    b_bar_stresses(element_, D, d, stress);
    stress_forces(element_, stress, f);
    EXPECT_LT((f - K_ * d).norm(), 1e-14 * K_.norm() * d.norm());
  }
}

TEST_P(BBar, TurnsWithThePolygonAndItsMaterial) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  Mat2 R;
  R << c, -s, s, c;
  Mat3 stresses;                         // turned: sigma' = T sigma, D' = T D T^T
  stresses << c * c, s * s, -2 * c * s,  //
      s * s, c * c, 2 * c * s,           //
      c * s, -c * s, c * c - s * s;
  MatrixXd rotation = MatrixXd::Zero(2 * n_, 2 * n_), turned;
  for (Index i = 0; i < n_; ++i) rotation.block<2, 2>(2 * i, 2 * i) = R;
  tabulate_with(hammer_rule(4));
  b_bar_stiffness(element_, anisotropic(), K_);
  polygon_ = R * polygon_;
  tabulate_with(hammer_rule(4));
  b_bar_stiffness(element_, stresses * anisotropic() * stresses.transpose(), turned);
  EXPECT_TRUE(turned.isApprox(rotation * K_ * rotation.transpose(), 1e-13));
}

TEST_P(BBar, IsThePlainElementWithoutLambda) {
  tabulate_with(hammer_rule(3));
  for (const double poisson : {0., -0.3}) {
    const Mat3 D = elasticity_matrix(1, poisson, Plane::strain);
    stiffness(element_, D, plain_);
    b_bar_stiffness(element_, D, K_);
    EXPECT_LT((K_ - plain_).norm(), 1e-15 * plain_.norm());
  }
}

TEST_P(BBar, PassesThePatchTest) {
  Mat2 G;
  G << 0.3, -0.2, 0.5, 0.1;
  const VectorXd d = linear_field(G, polygon_);
  for (int degree = 1; degree <= 5; ++degree) {
    tabulate_with(hammer_rule(degree));
    for (const Mat3& D : {anisotropic(), elasticity_matrix(1, 0.3, Plane::stress)}) {
      stiffness(element_, D, plain_);
      b_bar_stiffness(element_, D, K_);
      EXPECT_LT(((K_ - plain_) * d).norm(), 1e-13 * plain_.norm());
    }
  }
}

TEST_P(BBar, HasThreeZeroModesWithAnyRuleAtAnyPoissonRatio) {
  for (const double poisson : {0., 0.3, 0.4999, 0.499999})
    for (int degree = 1; degree <= 5; ++degree) {
      tabulate_with(hammer_rule(degree));
      b_bar_stiffness(element_, elasticity_matrix(1, poisson, Plane::strain), K_);
      // the dilatation is one mode as stiff as the bulk modulus: others are measured by the next
      const VectorXd values = eigenvalues(K_);
      EXPECT_LT(values.head(3).cwiseAbs().maxCoeff(), 1e-14 * values[2 * n_ - 1]);
      EXPECT_GT(values[3], 1e-3 * values[2 * n_ - 2]) << "degree " << degree << ", nu " << poisson;
    }
}

TEST_P(BBar, OneModeOnlyFeelsTheBulkModulus) {
  tabulate_with(hammer_rule(5));
  b_bar_stiffness(element_, nearly_incompressible, K_);
  const VectorXd values = eigenvalues(K_);
  EXPECT_GT(values[2 * n_ - 1], 1e4 * values[2 * n_ - 2]);
  stiffness(element_, nearly_incompressible, plain_);
  const VectorXd locked = eigenvalues(plain_);
  if (n_ > 3) {
    EXPECT_LT(locked[2 * n_ - 1], 1e4 * locked[2 * n_ - 2]);
  }
}

TEST(BBarOfTriangles, IsThePlainElement) {
  std::mt19937 random(1);
  TabulatedElement element;
  tabulate(support::random_convex_polygon(3, random), hammer_rule(2), wachspress, GradientCorrection::on,
           element);
  MatrixXd K, plain;
  stiffness(element, anisotropic(), plain);
  b_bar_stiffness(element, anisotropic(), K);
  EXPECT_LT((K - plain).norm(), 1e-14 * plain.norm());
}

TEST(BBarOfConcavePolygons, HasThreeZeroModes) {
  Points notched(2, 7);
  notched << 0, 2, 2, 1, 1, 0.5, 0,  //
      0, 0, 1, 1, 2, 2, 2;           // an L with a vertex on an edge
  TabulatedElement element;
  tabulate(notched, collapsed_gauss_rule(4, 4), mean_value, GradientCorrection::on, element);
  MatrixXd K;
  b_bar_stiffness(element, nearly_incompressible, K);
  const VectorXd values = eigenvalues(K);
  EXPECT_LT(values.head(3).cwiseAbs().maxCoeff(), 1e-14 * values[13]);
  EXPECT_GT(values[3], 1e-2 * values[12]);
}

}  // namespace
