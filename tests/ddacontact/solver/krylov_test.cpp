#include <ddacontact/solver/krylov.hpp>

#include <gtest/gtest.h>

#include <Eigen/QR>

using namespace ddacontact;

namespace {

/// Unsymmetric equations with diagonals of different sizes.
struct Equations {
  MatrixXd A;
  VectorXd b;

  explicit Equations(int n) : A(MatrixXd::Random(n, n)), b(VectorXd::Random(n)) {
    A.diagonal() += VectorXd::LinSpaced(n, 2 * std::sqrt(n), 9 * std::sqrt(n));
  }
  KrylovReport gmres(double tolerance, int most, VectorXd& x) const {
    return ddacontact::gmres([&](const VectorXd& in, VectorXd& out) { out = A * in; }, b, tolerance, most, x);
  }
  double left(const VectorXd& x) const { return (b - A * x).norm() / b.norm(); }
};

}  // namespace

/// Each iteration has one dimension more.
TEST(Krylov, GmresEndsAfterAsManyIterationsAsUnknowns) {
  for (int n : {1, 2, 5, 20, 60}) {
    const Equations e(n);
    VectorXd x;
    const KrylovReport report = e.gmres(1e-12, n, x);
    EXPECT_TRUE(report.converged) << n;
    EXPECT_LE(report.iterations, n);
    EXPECT_LE(e.left(x), 2e-12) << n;
  }
}

TEST(Krylov, GmresFindsTheLeastResidualSoFar) {
  const Equations e(12);
  MatrixXd space(12, 0);
  VectorXd along = e.b, x;
  double before = 1;
  for (int k = 1; k <= 6; ++k) {
    space.conservativeResize(12, k);
    space.col(k - 1) = along.normalized();
    along = e.A * space.col(k - 1);
    const VectorXd best = space * (e.A * space).colPivHouseholderQr().solve(e.b);
    const KrylovReport report = e.gmres(1e-12, k, x);
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.iterations, k);
    EXPECT_LE((x - best).norm(), 1e-9 * best.norm()) << k;
    EXPECT_LT(e.left(x), before);
    before = e.left(x);
  }
}

/// What it says and what it leaves agree at every tolerance.
TEST(Krylov, GmresStopsAtTheToleranceAndNoEarlierIterationHasIt) {
  for (double tolerance : {0.3, 1e-2, 1e-6}) {
    const Equations e(40);
    VectorXd x;
    const KrylovReport report = e.gmres(tolerance, 40, x);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(e.left(x), tolerance * (1 + 1e-6));
    EXPECT_FALSE(e.gmres(tolerance, report.iterations - 1, x).converged);
    EXPECT_GT(e.left(x), tolerance);
  }
}

TEST(Krylov, NothingIsThePriceOfNothing) {
  Equations e(7);
  e.b.setZero();
  VectorXd x = VectorXd::Ones(7);
  const KrylovReport report = e.gmres(1e-9, 9, x);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(x, VectorXd::Zero(7));
}

TEST(Krylov, SaysThatItHasNotConvergedWhereNothingSolves) {
  Equations e(2);
  VectorXd x;
  e.A.setZero();
  EXPECT_FALSE(e.gmres(1e-9, 40, x).converged);
  EXPECT_EQ(x, VectorXd::Zero(2));
}
