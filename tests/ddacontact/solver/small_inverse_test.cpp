#include <ddacontact/solver/small_inverse.hpp>
#include <ddacontact/solver/small_product.hpp>

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include <numeric>
#include <vector>

using namespace ddacontact;

namespace {

constexpr int largest = 16;

/// Symmetric, with eigenvalues from 1 to `condition`.
MatrixXd positive_matrix(int n, double condition) {
  const MatrixXd random = MatrixXd::Random(n, n), Q = random.householderQr().householderQ();
  const VectorXd exponents = VectorXd::LinSpaced(n, n == 1 ? 1 : 0, 1);
  const VectorXd values = exponents.unaryExpr([&](double e) { return std::pow(condition, e); });
  return Q * values.asDiagonal() * Q.transpose();
}

}  // namespace

TEST(SmallInverse, IsTheInverseToTheConditionsRoundOff) {
  for (int n = 1; n <= largest; ++n)
    for (double condition : {1., 1e3, 1e6, 1e10}) {
      const MatrixXd A = positive_matrix(n, condition), exact = A.inverse();
      MatrixXd inverse = A;
      ASSERT_TRUE(invert(inverse.data(), n));
      EXPECT_LE((inverse - exact).norm(), 1e-14 * condition * exact.norm()) << n << " rows, " << condition;
    }
}

/// Springs whose friction follows the normal force make blocks' matrices so.
TEST(SmallInverse, TakesUnsymmetricMatricesWithStrongDiagonals) {
  for (int n = 1; n <= largest; ++n) {
    const MatrixXd A = MatrixXd::Random(n, n) + n * MatrixXd::Identity(n, n);
    MatrixXd inverse = A;
    ASSERT_TRUE(invert(inverse.data(), n));
    EXPECT_LE((A * inverse - MatrixXd::Identity(n, n)).norm(), 1e-14 * n) << n;
  }
}

TEST(SmallInverse, RefusesSingularMatricesAndWhatIsNotFinite) {
  for (int n = 1; n <= largest; ++n) {
    for (int k = 0; k < n; ++k) {
      MatrixXd singular = MatrixXd::Identity(n, n);
      singular(k, k) = 0;
      EXPECT_FALSE(invert(singular.data(), n)) << n << " rows, row " << k;
    }
    MatrixXd not_finite = MatrixXd::Constant(n, n, std::nan("")), alike = MatrixXd::Ones(n + 1, n + 1);
    EXPECT_FALSE(invert(not_finite.data(), n)) << n;
    EXPECT_FALSE(n < largest && invert(alike.data(), n + 1)) << n;
  }
}

TEST(SmallInverse, MultipliesInBothPrecisions) {
  for (int n = 1; n <= largest; ++n) {
    const MatrixXd A = MatrixXd::Random(n, n);
    const VectorXd x = VectorXd::Random(n), exact = A * x;
    VectorXd y(n);
    multiply(A.data(), n, x.data(), y.data());
    EXPECT_LE((y - exact).norm(), 1e-15 * n) << n;
    const Eigen::MatrixXf single_A = A.cast<float>();
    const Eigen::VectorXf single_x = x.cast<float>();
    Eigen::VectorXf single_y(n);
    multiply(single_A.data(), n, single_x.data(), single_y.data());
    EXPECT_LE((single_y.cast<double>() - exact).norm(), 1e-6F * n) << n;
  }
}

/// Of consecutive unknowns and others, and of matrices within larger ones.
TEST(SmallProduct, AddsToTheUnknownsOfTheMatrixAlone) {
  for (int n = 0; n <= largest; ++n)
    for (int stride : {1, 2}) {
      const MatrixXd within = MatrixXd::Random(n + 3, n), A = within.topRows(n);
      std::vector<int> unknowns(static_cast<std::size_t>(n));
      for (int k = 0; k < n; ++k) unknowns[static_cast<std::size_t>(k)] = 2 + stride * k;
      const VectorXd x = VectorXd::Random(2 * n + 5), before = VectorXd::Random(x.size());
      VectorXd expected = before, y = before, y_within = before;
      expected(unknowns) += A * x(unknowns);
      add_product(A, unknowns, x, y);
      add_product(within.topRows(n), unknowns, x, y_within);
      EXPECT_LE((y - expected).norm(), 1e-14) << n;
      EXPECT_LE((y_within - expected).norm(), 1e-14) << n;
    }
}
