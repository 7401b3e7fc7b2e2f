#include <polyfem/core/error.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/material/neo_hooke.hpp>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

using namespace polyfem;

namespace {

constexpr double lambda = 3, mu = 0.7;
const Mat2 strained = (Mat2() << 1.4, 0.3, -0.2, 0.8).finished();

double energy(const Mat2& F) {
  const double log_J = std::log(F.determinant());
  return mu / 2 * (F.squaredNorm() - 2 - 2 * log_J) + lambda / 2 * log_J * log_J;
}

TEST(NeoHooke, StressIsTheDerivativeOfTheEnergyAndTheTangentThatOfTheStress) {
  const double step = 1e-5;
  const FiniteStress stress = neo_hooke(lambda, mu, strained);
  for (int k = 0; k < 4; ++k) {
    Mat2 shift = Mat2::Zero();
    shift.reshaped()[k] = step;
    EXPECT_NEAR((energy(strained + shift) - energy(strained - shift)) / (2 * step), stress.P.reshaped()[k],
                1e-8);
    const Mat2 slope =
        (neo_hooke(lambda, mu, strained + shift).P - neo_hooke(lambda, mu, strained - shift).P) / (2 * step);
    EXPECT_LT((slope.reshaped() - stress.tangent.col(k)).norm(), 1e-8);
  }
  EXPECT_LT((stress.tangent - stress.tangent.transpose()).norm(), 1e-14);
}

TEST(NeoHooke, DoesNotSeeRotations) {
  const Mat2 Q = Eigen::Rotation2Dd(1.1).toRotationMatrix();
  EXPECT_LT(neo_hooke(lambda, mu, Q).P.norm(), 1e-14);
  EXPECT_LT((neo_hooke(lambda, mu, Q * strained).P - Q * neo_hooke(lambda, mu, strained).P).norm(), 1e-14);
}

TEST(NeoHooke, IsLinearElasticityAtSmallStrains) {
  const double poisson = lambda / (2 * (lambda + mu)), young = 2 * mu * (1 + poisson);
  const Mat3 D = elasticity_matrix(young, poisson, Plane::strain);
  const Mat4 A = neo_hooke(lambda, mu, Mat2::Identity()).tangent;
  EXPECT_NEAR(A(0, 0), D(0, 0), 1e-14);
  EXPECT_NEAR(A(0, 3), D(0, 1), 1e-14);
  EXPECT_NEAR(A(1, 1), D(2, 2), 1e-14);
  EXPECT_NEAR(A(1, 2), D(2, 2), 1e-14);
}

TEST(NeoHooke, RefusesMaterialTurnedInsideOut) {
  EXPECT_THROW(neo_hooke(lambda, mu, Vec2(1, -1).asDiagonal()), Error);
}

}  // namespace
