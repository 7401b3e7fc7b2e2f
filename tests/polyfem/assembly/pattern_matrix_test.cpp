#include <polyfem/assembly/pattern_matrix.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace polyfem;

namespace {

/// Elements of 1 to 8 rows, some left out, some repeated within an element.
Connectivity random_connectivity(int n_rows, int n_elements, std::mt19937& random) {
  std::uniform_int_distribution<int> row(-2, n_rows - 1), size(1, 8);
  Connectivity connectivity;
  for (int e = 0; e < n_elements; ++e) {
    std::vector<int> rows(static_cast<std::size_t>(size(random)));
    for (int& r : rows) r = row(random);
    if (e % 3 == 0) rows.back() = rows.front();
    connectivity.append(rows);
  }
  return connectivity;
}

/// Elements of up to four different groups of so many rows in any order, some left out.
Connectivity random_groups(int size, int n_rows, int n_elements, std::mt19937& random) {
  std::vector<int> groups(static_cast<std::size_t>(n_rows / size));
  std::iota(groups.begin(), groups.end(), 0);
  std::uniform_int_distribution<std::size_t> count(1, std::min<std::size_t>(4, groups.size()));
  Connectivity connectivity;
  for (int e = 0; e < n_elements; ++e) {
    std::ranges::shuffle(groups, random);
    std::vector<int> rows;
    for (std::size_t k = 0, n = count(random); k < n; ++k)
      for (int row = 0; row < size; ++row) rows.push_back(e % 3 == 0 && k == 1 ? -1 : size * groups[k] + row);
    connectivity.append(rows);
  }
  return connectivity;
}

MatrixXd random_symmetric(Index k, std::mt19937& random) {
  std::uniform_real_distribution<double> value(-1, 1);
  MatrixXd matrix(k, k);
  for (Index j = 0; j < k; ++j)
    for (Index i = 0; i <= j; ++i) matrix(i, j) = matrix(j, i) = value(random);
  return matrix;
}

/// The oracle: every entry of the element to its place in a dense matrix.
void add_dense(std::span<const int> rows, const MatrixXd& matrix, MatrixXd& sum) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j)
      if (rows[i] >= 0 && rows[j] >= 0)
        sum(rows[i], rows[j]) += matrix(static_cast<Index>(i), static_cast<Index>(j));
}

struct Size {
  int n_rows, n_elements;
  int group = 1;  ///< rows come in groups of so many
};

class PatternMatrixOfRandomElements : public testing::TestWithParam<Size> {
 protected:
  void SetUp() override { matrix_.set_connectivity(n_, connectivity_); }
  void expect_equal(const MatrixXd& dense) const {
    const SparseMatrix& lower = matrix_.lower();
    ASSERT_TRUE(lower.isCompressed());
    EXPECT_LT((MatrixXd(lower) - MatrixXd(dense.triangularView<Eigen::Lower>())).norm(),
              1e-13 * (1 + dense.norm()));
  }

  std::mt19937 random_{1};
  int n_ = GetParam().n_rows;
  Connectivity connectivity_ = GetParam().group == 1
                                   ? random_connectivity(n_, GetParam().n_elements, random_)
                                   : random_groups(GetParam().group, n_, GetParam().n_elements, random_);
  PatternMatrix matrix_;
};
INSTANTIATE_TEST_SUITE_P(Sizes, PatternMatrixOfRandomElements,
                         testing::Values(Size{1, 0}, Size{1, 5}, Size{3, 40}, Size{10, 4}, Size{60, 100},
                                         Size{2, 5, 2}, Size{10, 40, 2}, Size{60, 100, 2}, Size{3, 5, 3},
                                         Size{9, 40, 3}, Size{60, 100, 3}, Size{61, 100, 3}));

/// One element more that does not come in groups takes away what the others save: most of the places and of
/// the rows.
TEST(PatternMatrix, KeepsAPlaceAndARowOfEachGroup) {
  for (const int group : {2, 3}) {
    std::mt19937 random{2};
    Connectivity connectivity = random_groups(group, 240, 1000, random);
    double n_points = 0;
    for (int e = 0; e < connectivity.n_elements(); ++e) {
      const auto k = static_cast<double>(connectivity.rows_of(e).size());
      n_points += k * (k + 1) / 2;
    }
    PatternMatrix matrix;
    matrix.set_connectivity(240, connectivity);
    const double grouped = matrix.memory();
    const std::vector<int> one{0};
    connectivity.append(one);
    matrix.set_connectivity(240, connectivity);
    const double n_rows = static_cast<double>(connectivity.rows.size()), saved = 1 - 1. / group;
    EXPECT_GT(matrix.memory() - grouped, sizeof(int) * (saved * n_rows + 0.6 * n_points));
  }
}

TEST_P(PatternMatrixOfRandomElements, SumsWhatDenseAssemblySums) {
  MatrixXd dense = MatrixXd::Zero(n_, n_);
  for (int e = 0; e < connectivity_.n_elements(); ++e) {
    const auto rows = connectivity_.rows_of(e);
    const MatrixXd element = random_symmetric(static_cast<Index>(rows.size()), random_);
    matrix_.add(e, element);
    add_dense(rows, element, dense);
  }
  expect_equal(dense);
}

TEST_P(PatternMatrixOfRandomElements, AddsProductsOfTwoVectorsBelowTheDiagonalAndAbove) {
  std::uniform_real_distribution<double> value(-1, 1);
  for (int round = 0; round < 2; ++round) {
    MatrixXd dense = MatrixXd::Zero(n_, n_);
    matrix_.set_zero();
    EXPECT_EQ(matrix_.more_above().size(), 0);
    for (int e = 0; e < connectivity_.n_elements(); ++e) {
      const auto rows = connectivity_.rows_of(e);
      const Index k = static_cast<Index>(rows.size());
      VectorXd a(k), b(k);
      for (Index l = 0; l < k; ++l) {
        a[l] = value(random_);
        b[l] = value(random_);
      }
      const double factor = value(random_);
      const std::span<const double> of_a(a.data(), rows.size()), of_b(b.data(), rows.size());
      if (e % 2 == 0) {
        matrix_.add_outer(e, factor, of_a, of_b);
        add_dense(rows, factor * a * b.transpose(), dense);
      } else {
        matrix_.add_outer(e, factor, of_a);
        add_dense(rows, factor * a * a.transpose(), dense);
      }
    }
    expect_equal(dense);
    if (connectivity_.n_elements() == 0) continue;
    SparseMatrix above = matrix_.lower();
    const VectorXd more_above = matrix_.more_above();
    ASSERT_EQ(more_above.size(), above.nonZeros());
    Eigen::Map<VectorXd>(above.valuePtr(), above.nonZeros()) += more_above;
    matrix_.forget_above();
    EXPECT_EQ(matrix_.more_above().size(), 0);
    EXPECT_LT((MatrixXd(above).transpose() - MatrixXd(dense.triangularView<Eigen::Upper>())).norm(),
              1e-13 * (1 + dense.norm()));
  }
}

TEST_P(PatternMatrixOfRandomElements, AddsOuterProductsLikeTheirFullMatrices) {
  std::uniform_real_distribution<double> value(-1, 1);
  MatrixXd dense = MatrixXd::Zero(n_, n_);
  for (int e = 0; e < connectivity_.n_elements(); ++e) {
    const auto rows = connectivity_.rows_of(e);
    VectorXd a(static_cast<Index>(rows.size()));
    for (double& entry : a) entry = value(random_);
    const double factor = value(random_);
    matrix_.add_outer(e, factor, {a.data(), rows.size()});
    add_dense(rows, factor * a * a.transpose(), dense);
  }
  expect_equal(dense);
}

TEST_P(PatternMatrixOfRandomElements, HasTheDiagonalAndEveryPairInOrder) {
  MatrixXd expected = MatrixXd::Identity(n_, n_);
  for (int e = 0; e < connectivity_.n_elements(); ++e) {
    const Index k = static_cast<Index>(connectivity_.rows_of(e).size());
    add_dense(connectivity_.rows_of(e), MatrixXd::Ones(k, k), expected);
  }
  const SparseMatrix& lower = matrix_.lower();
  EXPECT_EQ(lower.nonZeros(), (MatrixXd(expected.triangularView<Eigen::Lower>()).array() != 0).count());
  for (int c = 0; c < n_; ++c) {
    int previous = -1;
    for (SparseMatrix::InnerIterator entry(lower, c); entry; ++entry) {
      EXPECT_GT(entry.row(), previous);
      EXPECT_GE(entry.row(), c);
      EXPECT_NE(expected(entry.row(), c), 0);
      previous = static_cast<int>(entry.row());
    }
  }
}

TEST_P(PatternMatrixOfRandomElements, ForgetsItsValuesButNotItsPattern) {
  const Index non_zeros = matrix_.lower().nonZeros();
  for (int e = 0; e < connectivity_.n_elements(); ++e) {
    const Index k = static_cast<Index>(connectivity_.rows_of(e).size());
    matrix_.add(e, MatrixXd::Ones(k, k));
  }
  matrix_.set_zero();
  EXPECT_EQ(matrix_.lower().norm(), 0);
  EXPECT_EQ(matrix_.lower().nonZeros(), non_zeros);
}

TEST_P(PatternMatrixOfRandomElements, TellsWhetherThePatternIsAnother) {
  EXPECT_FALSE(matrix_.set_connectivity(n_, connectivity_));
  EXPECT_TRUE(matrix_.set_connectivity(n_ + 1, connectivity_));
  EXPECT_FALSE(matrix_.set_connectivity(n_ + 1, connectivity_));
  connectivity_.append(std::vector<int>{n_, 0});
  EXPECT_TRUE(matrix_.set_connectivity(n_ + 1, connectivity_));
}

TEST_P(PatternMatrixOfRandomElements, SumsOtherElementsInTheSamePattern) {
  Connectivity turned;
  for (int e = connectivity_.n_elements(); e-- > 0;) turned.append(connectivity_.rows_of(e));
  turned.append(std::vector<int>{n_ - 1});
  EXPECT_FALSE(matrix_.set_connectivity(n_, turned));
  MatrixXd dense = MatrixXd::Zero(n_, n_);
  for (int e = 0; e < turned.n_elements(); ++e) {
    const auto rows = turned.rows_of(e);
    const MatrixXd element = random_symmetric(static_cast<Index>(rows.size()), random_);
    matrix_.add(e, element);
    add_dense(rows, element, dense);
  }
  expect_equal(dense);
}

TEST(PatternMatrix, FeedsCholesky) {
  Connectivity springs;  // a chain of four unknowns held at its far end, one spring an element
  for (int k = 0; k < 3; ++k) springs.append(std::vector<int>{k, k + 1});
  springs.append(std::vector<int>{3, -1});
  PatternMatrix K;
  K.set_connectivity(4, springs);
  for (int e = 0; e < 4; ++e) K.add_outer(e, 2., std::vector<double>{1, -1});
  Cholesky cholesky;
  cholesky.analyze(K.lower());
  ASSERT_TRUE(cholesky.factorize(K.lower()));
  VectorXd x;
  cholesky.solve(VectorXd::Unit(4, 0), x);  // unit force through springs of stiffness 2
  EXPECT_LT((x - Eigen::Vector4d(2, 1.5, 1, 0.5)).norm(), 1e-14);
}

}  // namespace
