/// \file Sparse matrix of symmetric pattern, assembled from small dense ones into precomputed slots.
#pragma once

#include <polyfem/assembly/cholesky.hpp>

#include <span>
#include <vector>

namespace polyfem {

/// Which rows each small matrix touches: element e has rows[first[e]] .. rows[first[e + 1] - 1], a row < 0
/// being left out (a prescribed degree of freedom).
struct Connectivity {
  std::vector<int> first{0};
  std::vector<int> rows;

  int n_elements() const { return static_cast<int>(first.size()) - 1; }
  std::span<const int> rows_of(int element) const {
    return {rows.data() + first[element], static_cast<std::size_t>(first[element + 1] - first[element])};
  }
  void clear() {
    first.assign(1, 0);
    rows.clear();
  }
  void append(std::span<const int> element_rows) {
    rows.insert(rows.end(), element_rows.begin(), element_rows.end());
    first.push_back(static_cast<int>(rows.size()));
  }
  bool operator==(const Connectivity&) const = default;
};

/// The lower triangle of a sum of small symmetric matrices, and of products of vectors what the upper
/// triangle has more. The pattern is the union over all elements of the connectivity, with the diagonal;
/// where each entry of each element goes is found once per connectivity.
class PatternMatrix {
 public:
  /// Prepares for these elements; false when the pattern is the one it was: an analysis of it holds on.
  bool set_connectivity(int n_rows, const Connectivity& connectivity);

  void set_zero();
  /// 1 on the diagonal.
  void set_identity();
  /// Adds a dense symmetric matrix (k x k for the k rows of the element, left-out rows included).
  void add(int element, const Eigen::Ref<const MatrixXd>& matrix);
  /// Adds factor * a a^T.
  void add_outer(int element, double factor, std::span<const double> a);
  /// Adds factor * a b^T.
  void add_outer(int element, double factor, std::span<const double> a, std::span<const double> b);

  const SparseMatrix& lower() const { return lower_; }
  /// Of the entries above the diagonal less those below it, see Cholesky::factorize; empty: it is symmetric.
  const VectorXd& more_above() const { return more_above_; }
  /// Frees their memory.
  void forget_above() { more_above_.resize(0); }
  /// Bytes of the heap.
  double memory() const;

 private:
  /// Whether the last connectivity was this one.
  bool is_of(const Connectivity& connectivity) const;
  /// Adds what of a matrix falls on the diagonal or below it to the values at the slots: entry(i, j) of the
  /// rows of the element.
  template <class Entry>
  void add_entries(int element, const Entry& entry, double* values);
  template <int size, class Entry>
  void add_groups(int element, const Entry& entry, double* values);

  /// The rows of all elements come in groups of so many, a multiple of it and the next ones: the columns of a
  /// group have the same rows then, and where one entry of two groups is tells where the others are.
  int group_size_ = 1;
  Connectivity groups_;                  ///< first rows of the groups of each element
  std::vector<std::size_t> first_slot_;  ///< of each element in slot_
  std::vector<int> slot_;  ///< index into lower_.valuePtr() for each two groups of an element, or -1
  SparseMatrix lower_;
  VectorXd more_above_;
};

}  // namespace polyfem
