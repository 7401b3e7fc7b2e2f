#include <polyfem/assembly/dense_product.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <list>
#include <random>
#include <vector>

using polyfem::DenseBlock;

namespace {

/// C -= A B^T, the sums of four columns of A rounded one after the other, then those left over one by one.
template <class Real>
void subtract_one_by_one(const DenseBlock<Real>& A, const DenseBlock<Real>& B, const DenseBlock<Real>& C) {
  for (int c = 0; c < C.n_columns; ++c)
    for (int r = 0; r < C.n_rows; ++r) {
      int k = 0;
      for (; k + 4 <= A.n_columns; k += 4) {
        Real sum = B.at(c, k) * A.at(r, k);
        for (int l = k + 1; l < k + 4; ++l) sum += B.at(c, l) * A.at(r, l);
        C.column(c)[r] -= sum;
      }
      for (; k < A.n_columns; ++k) C.column(c)[r] -= B.at(c, k) * A.at(r, k);
    }
}

template <class Real>
class DenseProduct : public testing::Test {
 protected:
  /// A block of random numbers with a few rows of others below it.
  DenseBlock<Real> block(int n_rows, int n_columns) {
    std::vector<Real>& numbers = memory_.emplace_back(static_cast<std::size_t>((n_rows + 3) * n_columns));
    for (Real& number : numbers) number = static_cast<Real>(std::uniform_real_distribution(-1., 1.)(random_));
    return {numbers.data(), n_rows, n_columns, n_rows + 3};
  }
  /// C - A B^T by the library in C, the block made last, and in what is returned by plain loops.
  std::vector<Real> subtract(const DenseBlock<Real>& A, const DenseBlock<Real>& B, const DenseBlock<Real>& C,
                             bool is_lower, bool by_blas) {
    const std::vector<Real> before = memory_.back();
    subtract_one_by_one(A, B, C);
    const std::vector<Real> expected = memory_.back();
    std::ranges::copy(before, memory_.back().begin());
    subtract_product(A, B, C, is_lower, by_blas);
    return expected;
  }

 private:
  std::mt19937 random_{1};
  std::list<std::vector<Real>> memory_;
};

using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(DenseProduct, Reals);

}  // namespace

/// Whatever instructions the processor has.
TYPED_TEST(DenseProduct, IsRoundedAsByPlainLoopsToTheBit) {
  for (int n_rows = 1; n_rows <= 19; ++n_rows)
    for (int n_columns = 1; n_columns <= n_rows; ++n_columns)
      for (int n_terms = 1; n_terms <= 13; ++n_terms)
        for (const bool is_lower : {false, true}) {
          const DenseBlock<TypeParam> A = this->block(n_rows, n_terms), B = this->block(n_columns, n_terms),
                                      C = this->block(n_rows, n_columns);
          const std::vector<TypeParam> expected = this->subtract(A, B, C, is_lower, false);
          for (int c = 0; c < n_columns; ++c)
            for (int r = 0; r < C.stride; ++r) {
              const auto at = static_cast<std::size_t>(c * C.stride + r);
              if (is_lower && r < c) continue;
              ASSERT_EQ(C.first[at], expected[at]) << n_rows << ' ' << n_columns << ' ' << n_terms;
            }
        }
}

/// Of A A^T the lower triangle alone counts.
TYPED_TEST(DenseProduct, ByBlasAgreesToRoundOff) {
  for (const bool is_square : {true, false}) {
    const int n_rows = 60, n_columns = 20, n_terms = 12;
    const DenseBlock<TypeParam> A = this->block(n_rows, n_terms);
    const DenseBlock<TypeParam> B = is_square ? A : this->block(n_columns, n_terms),
                                C = this->block(n_rows, n_columns);
    const std::vector<TypeParam> expected = this->subtract(A, B, C, true, true);
    for (int c = 0; c < n_columns; ++c)
      for (int r = c; r < n_rows; ++r) {
        const auto at = static_cast<std::size_t>(c * C.stride + r);
        EXPECT_NEAR(C.first[at], expected[at], 30 * std::numeric_limits<TypeParam>::epsilon());
      }
  }
}
