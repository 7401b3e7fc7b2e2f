/// \file Sparse factorization that keeps its analysis while the pattern holds: CHOLMOD orders, fronts eliminate.
#pragma once

#include <polyfem/core/types.hpp>

#include <Eigen/SparseCore>

#include <memory>
#include <span>
#include <vector>

namespace polyfem {

/// Compressed columns with int indices, as CHOLMOD takes them.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// What was done for factors and solutions, and the seconds that it took.
struct CholeskyWork {
  int n_analyses = 0, n_factorizations = 0, n_solves = 0;
  double analysis = 0, factorization = 0, solution = 0;  ///< s

  CholeskyWork& operator+=(const CholeskyWork& other) {
    n_analyses += other.n_analyses;
    n_factorizations += other.n_factorizations;
    n_solves += other.n_solves;
    analysis += other.analysis;
    factorization += other.factorization;
    solution += other.solution;
    return *this;
  }
  /// Since `before`.
  CholeskyWork since(const CholeskyWork& before) const {
    return {n_analyses - before.n_analyses,       n_factorizations - before.n_factorizations,
            n_solves - before.n_solves,           analysis - before.analysis,
            factorization - before.factorization, solution - before.solution};
  }
};

/// K = L L^T of a symmetric positive definite matrix given by its lower triangle; K = L U of one whose pattern
/// alone is symmetric.
class Cholesky {
 public:
  Cholesky();
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  /// Finds the ordering and the pattern of L. Call again only when the pattern of K changes.
  void analyze(const SparseMatrix& lower);
  /// The same by nested dissection (METIS), which takes several times as long and leaves fewer entries of
  /// large matrices: pays for many factors and solutions.
  void dissect(const SparseMatrix& lower);
  /// The same with the ordering given: the rows in the order in which to eliminate them (up to a reordering
  /// that leaves the number of entries of L as it is).
  void analyze(const SparseMatrix& lower, std::span<const int> order);
  /// Whether the last analysis was made: one that lacked memory was not.
  bool is_analyzed() const;
  /// Computes L for the analyzed pattern; false when K is not positive definite (nothing to solve with then).
  [[nodiscard]] bool factorize(const SparseMatrix& lower);
  /// K = L U of the matrix whose upper triangle has so much more than the lower one: `more_above`, at the
  /// places of the entries of `lower`, transposed. Rows are not exchanged: for matrices that would be positive
  /// definite without that. False: a pivot is 0, or no number.
  [[nodiscard]] bool factorize(const SparseMatrix& lower, const VectorXd& more_above);
  /// `factorize(lower)` in single precision alone, of half the memory: then there are rough solutions only, see
  /// `refined_solution`. False, and nothing is made, where it gains no time (small matrices), or where pivots
  /// lose half of the digits: whether K is positive definite is not said by this.
  [[nodiscard]] bool factorize_roughly(const SparseMatrix& lower);
  /// x = K^-1 b with the last factor.
  void solve(const VectorXd& b, VectorXd& x);
  /// x = K^-1 b with the factor of `factorize_roughly`, which must be the last one, in single precision.
  void solve_roughly(const VectorXd& b, VectorXd& x);

  /// The row whose pivot did not serve in the last factorization; -1 when all did.
  int failed_row() const;
  /// Entries of L that the last analysis found.
  double n_factor_entries() const;
  /// Bytes of the heap: of the factor, what it is made in, and what CHOLMOD keeps.
  double memory() const;

  int n_analyses() const { return work_.n_analyses; }
  int n_factorizations() const { return work_.n_factorizations; }
  int n_solves() const { return work_.n_solves; }
  const CholeskyWork& work() const { return work_; }

 private:
  bool factorize(const SparseMatrix& lower, const VectorXd* more_above);

  struct Factor;
  std::unique_ptr<Factor> factor_;
  CholeskyWork work_;
};

/// An order in which to eliminate the rows of a symmetric pattern so that few entries arise, by approximate
/// minimum degree (AMD).
///
/// \param[in] first, row  the lower triangle with its diagonal: column c has the rows row[first[c]] ..
///                        row[first[c + 1] - 1], ascending
/// \param[in] group       of each row: those of a lower group are eliminated before (CAMD); empty: all are of
///                        one group
std::vector<int> minimum_degree_order(std::span<const int> first, std::span<const int> row,
                                      std::span<const int> group = {});

}  // namespace polyfem
