#include <ddacontact/solver/krylov.hpp>

#include <gtest/gtest.h>

#include <Eigen/QR>

using namespace ddacontact;

namespace {

/// Unsymmetric equations with diagonals of different sizes, and these as preconditioner.
template <class Real>
struct Equations {
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> A;
  Vector b;

  explicit Equations(int n) {
    A = MatrixXd::Random(n, n).cast<Real>();
    A.diagonal() += VectorXd::LinSpaced(n, 2 * std::sqrt(n), 9 * std::sqrt(n)).cast<Real>();
    b = VectorXd::Random(n).cast<Real>();
  }
  KrylovReport bicgstab(double tolerance, int most, Vector& x) const {
    return ddacontact::bicgstab(
        [&](const Vector& in, Vector& out, Vector& product) {
          out = in.cwiseQuotient(A.diagonal());
          product = A * out;
        },
        b, tolerance, most, x);
  }
  KrylovReport gmres(double tolerance, int most, Vector& x) const {
    return ddacontact::gmres([&](const Vector& in, Vector& out) { out = A * in; }, b, tolerance, most, x);
  }
  double left(const Vector& x) const {
    return static_cast<double>((b - A * x).norm()) / static_cast<double>(b.norm());
  }
};

}  // namespace

TEST(Krylov, BicgstabSolvesUnsymmetricEquationsToTheTolerance) {
  for (int n : {1, 2, 5, 20, 60})
    for (double tolerance : {1e-2, 1e-5, 1e-10}) {
      const Equations<double> e(n);
      VectorXd x;
      const KrylovReport report = e.bicgstab(tolerance, 40, x);
      EXPECT_TRUE(report.converged) << n;
      EXPECT_LE(report.iterations, n) << "with directions apart from all before";
      EXPECT_LE(e.left(x), tolerance + 1e-14) << n;
      if (report.iterations == 1) continue;
      EXPECT_FALSE(e.bicgstab(tolerance, report.iterations - 1, x).converged) << "one fewer would have done";
    }
}

TEST(Krylov, BicgstabSolvesInSinglePrecisionToAFewDigits) {
  for (int n : {1, 5, 60}) {
    const Equations<float> e(n);
    Eigen::VectorXf x;
    EXPECT_TRUE(e.bicgstab(1e-4, 40, x).converged) << n;
    EXPECT_LE(e.left(x), 1.1e-4) << n;
  }
}

/// Each iteration has one dimension more.
TEST(Krylov, GmresEndsAfterAsManyIterationsAsUnknowns) {
  for (int n : {1, 2, 5, 20, 60}) {
    const Equations<double> e(n);
    VectorXd x;
    const KrylovReport report = e.gmres(1e-12, n, x);
    EXPECT_TRUE(report.converged) << n;
    EXPECT_LE(report.iterations, n);
    EXPECT_LE(e.left(x), 2e-12) << n;
  }
}

TEST(Krylov, GmresFindsTheLeastResidualSoFar) {
  const Equations<double> e(12);
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
    const Equations<double> e(40);
    VectorXd x;
    const KrylovReport report = e.gmres(tolerance, 40, x);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(e.left(x), tolerance * (1 + 1e-6));
    EXPECT_FALSE(e.gmres(tolerance, report.iterations - 1, x).converged);
    EXPECT_GT(e.left(x), tolerance);
  }
}

TEST(Krylov, NothingIsThePriceOfNothing) {
  Equations<double> e(7);
  e.b.setZero();
  for (bool least : {false, true}) {
    VectorXd x = VectorXd::Ones(7);
    const KrylovReport report = least ? e.gmres(1e-9, 9, x) : e.bicgstab(1e-9, 9, x);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.iterations, 0);
    EXPECT_EQ(x, VectorXd::Zero(7));
  }
}

/// A turn by a right angle leaves bi-conjugate gradients nothing to divide by; nothing solves a matrix of 0.
TEST(Krylov, SaysThatItHasNotConvergedWhereItBreaksDown) {
  Equations<double> e(2);
  e.A << 1, -1, 1, 1;
  e.A.diagonal().setConstant(1e-300);
  e.b << 1, 0;
  VectorXd x;
  EXPECT_FALSE(e.bicgstab(1e-9, 40, x).converged);
  EXPECT_TRUE(e.gmres(1e-9, 40, x).converged);
  e.A.setZero();
  EXPECT_FALSE(e.gmres(1e-9, 40, x).converged);
  EXPECT_EQ(x, VectorXd::Zero(2));
}

TEST(Krylov, SumsOfPartsHaveEveryEntryOnce) {
  for (Index n : {0, 1, 4096, 4097, 20000}) {
    const VectorXd numbers = VectorXd::LinSpaced(n, 1, static_cast<double>(n));
    EXPECT_EQ(sum_of_parts(n, [&](Index k, Index m) { return numbers.segment(k, m).sum(); }),
              static_cast<double>(n * (n + 1) / 2));
  }
}

/// More entries than one thread sums by itself.
TEST(Krylov, GivesTheSameBytesForAnyNumberOfThreads) {
  const Index n = 20000;
  const VectorXd b = VectorXd::Random(n);
  const auto apply = [](const VectorXd& in, VectorXd& out, VectorXd& product) {
    out = in;
    product = 4 * in;
    product.tail(in.size() - 1) -= 2 * in.head(in.size() - 1);
    product.head(in.size() - 1) -= in.tail(in.size() - 1);
  };
  VectorXd x[2];
  for (int threads : {1, 2}) {
    polyfem::set_threads(threads);
    EXPECT_TRUE(bicgstab(apply, b, 1e-9, 100, x[threads - 1]).converged);
  }
  polyfem::set_threads(1);
  EXPECT_EQ(x[0], x[1]);
  VectorXd same, product;
  apply(x[0], same, product);
  EXPECT_LE((b - product).norm(), 1.1e-9 * b.norm());
}
