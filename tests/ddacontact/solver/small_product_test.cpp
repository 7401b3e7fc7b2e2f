#include <ddacontact/solver/small_product.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace ddacontact;

/// Of consecutive unknowns and others, and of matrices within larger ones.
TEST(SmallProduct, AddsToTheUnknownsOfTheMatrixAlone) {
  for (int n = 0; n <= 16; ++n)
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
