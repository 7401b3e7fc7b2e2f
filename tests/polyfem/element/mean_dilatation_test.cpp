#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/finite_strain.hpp>
#include <polyfem/element/mean_dilatation.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/element/small_strain.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <random>

using namespace polyfem;

namespace {

constexpr double lame = 1000, shear = 1;

void rubber_forces(const TabulatedElement& element, const VectorXd& d, MatrixXd& K, VectorXd& forces) {
  finite_strain_forces(
      element, [](Index, const Mat2& F) { return neo_hooke(0, shear, F); }, d, K, forces);
  add_mean_dilatation(
      element, [](double J) { return neo_hooke_volume(lame, J); }, d, K, forces);
}

/// First (false) or second order.
class MeanDilatation : public testing::TestWithParam<bool> {
 protected:
  MeanDilatation() {
    const PolygonMesh mesh = voronoi(support::rectangle(2, 1), {.n_cells = 12});
    if (GetParam()) {
      cell_ = with_edge_midpoints(mesh).outline(5);
      tabulate_quadratic(cell_, dunavant_rule(4), suitable_basis(quadratic_corners(cell_)),
                         GradientCorrection::on, element_);
    } else {
      cell_ = mesh.outline(5);
      tabulate(cell_, dunavant_rule(4), suitable_basis(cell_), GradientCorrection::on, element_);
    }
  }
  VectorXd random_displacements(double size) const {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> moved(-size, size);
    VectorXd d(2 * cell_.cols());
    for (double& value : d) value = moved(random);
    return d;
  }
  Points cell_;
  TabulatedElement element_;
};
INSTANTIATE_TEST_SUITE_P(Orders, MeanDilatation, testing::Values(false, true));

TEST_P(MeanDilatation, TangentIsTheSymmetricDerivativeOfForces) {
  const VectorXd d = random_displacements(0.02);
  MatrixXd K, unused;
  VectorXd forces, ahead, behind;
  rubber_forces(element_, d, K, forces);
  const double step = 1e-6;
  for (Index k = 0; k < d.size(); ++k) {
    const VectorXd shift = step * VectorXd::Unit(d.size(), k);
    rubber_forces(element_, d + shift, unused, ahead);
    rubber_forces(element_, d - shift, unused, behind);
    EXPECT_LT(((ahead - behind) / (2 * step) - K.col(k)).norm(), 1e-7 * K.norm());
  }
  EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
}

TEST_P(MeanDilatation, AtSmallStrainsItIsBBar) {
  MatrixXd K, b_bar;
  VectorXd forces;
  const VectorXd at_rest = VectorXd::Zero(2 * cell_.cols());
  rubber_forces(element_, at_rest, K, forces);
  const double nu = lame / (2 * (lame + shear));
  b_bar_stiffness(element_, elasticity_matrix(2 * shear * (1 + nu), nu, Plane::strain), b_bar);
  EXPECT_LT((K - b_bar).norm(), 1e-12 * b_bar.norm());

  const VectorXd d = random_displacements(1);
  const Mat3 rest = Vec3(2, 2, 1).asDiagonal() * shear;
  small_strain_forces(
      element_,
      [&](Index, const Vec3& strain, Mat3& tangent) {
        tangent = rest;
        return Vec3(rest * strain);
      },
      d, K, forces);
  add_mean_dilatation(element_, lame, d, K, forces);
  EXPECT_LT((K - b_bar).norm(), 1e-12 * b_bar.norm());
  EXPECT_LT((forces - b_bar * d).norm(), 1e-12 * b_bar.norm() * d.norm());
}

TEST_P(MeanDilatation, UniformDeformationHasTheForcesOfTheWholeMaterial) {
  const Mat2 F = (Mat2() << 1.3, 0.2, -0.4, 0.8).finished();
  const VectorXd d = ((F - Mat2::Identity()) * cell_).reshaped();
  MatrixXd K;
  VectorXd forces, whole;
  rubber_forces(element_, d, K, forces);
  finite_strain_forces(
      element_, [](Index, const Mat2& f) { return neo_hooke(lame, shear, f); }, d, K, whole);
  EXPECT_LT((forces - whole).norm(), 1e-12 * whole.norm());
}

TEST_P(MeanDilatation, OnlyRigidMotionsCostNothing) {
  MatrixXd K;
  VectorXd forces;
  rubber_forces(element_, VectorXd::Zero(2 * cell_.cols()), K, forces);
  const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(K).eigenvalues();
  EXPECT_LT(std::abs(values[2]), 1e-12 * values[values.size() - 1]);
  EXPECT_GT(values[3], 0.05 * shear);
}

TEST(NeoHookeVolume, AddsUpToTheWholeMaterial) {
  const Mat2 F = (Mat2() << 1.4, 0.3, -0.2, 0.8).finished();
  const double J = F.determinant(), h = 1e-6;
  const VolumeStress volume = neo_hooke_volume(3, J);
  const Mat2 cofactor = J * F.inverse().transpose();
  EXPECT_LT((neo_hooke(0, 0.7, F).P + volume.stress * cofactor - neo_hooke(3, 0.7, F).P).norm(), 1e-14);
  EXPECT_NEAR(volume.tangent,
              (neo_hooke_volume(3, J + h).stress - neo_hooke_volume(3, J - h).stress) / (2 * h), 1e-8);
  EXPECT_THROW(neo_hooke_volume(3, -0.1), Error);
}

}  // namespace
