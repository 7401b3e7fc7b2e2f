/// \file Factors L L^T, and L U of matrices whose pattern is symmetric, made by fronts, one for each group of
/// columns: what a group's elimination subtracts from the rows below it waits for the group above (I. S. Duff and J. K. Reid, "The multifrontal solution of
/// indefinite sparse symmetric linear equations", 1983).
#pragma once

#include <polyfem/core/large_vector.hpp>

#include <cstddef>
#include <span>
#include <vector>

struct cholmod_factor_struct;

namespace polyfem {

/// A block of a matrix stored by columns.
template <class Real>
struct DenseBlock {
  Real* first;
  int n_rows, n_columns, stride;

  Real* column(int c) const { return first + static_cast<std::ptrdiff_t>(c) * stride; }
  Real at(int row, int column) const { return this->column(column)[row]; }
  DenseBlock below(int row, int column) const {
    return {this->column(column) + row, n_rows - row, n_columns - column, stride};
  }
  DenseBlock columns(int n) const { return {first, n_rows, n, stride}; }
};

/// The fronts of a matrix: what follows from where a supernodal factor of CHOLMOD has entries. Columns and rows
/// are in the order of elimination, groups in postorder.
class FrontTree {
 public:
  /// \param[in] L  analyzed; it has to live as long
  explicit FrontTree(const cholmod_factor_struct& L);

  int n_groups() const { return static_cast<int>(n_children_.size()); }
  int first_column(int s) const { return super_[s]; }
  int n_columns(int s) const { return super_[s + 1] - super_[s]; }
  /// Of the front: those of its columns and those below.
  std::span<const int> rows(int s) const { return {row_ + first_row_[s], row_ + first_row_[s + 1]}; }
  /// Where the columns of the group begin among the entries of L: as many as the front has rows for each.
  std::ptrdiff_t first_entry(int s) const { return first_entry_[s]; }
  int n_below(int s) const { return first_row_[s + 1] - first_row_[s] - n_columns(s); }
  /// Groups that pass up to this one.
  int n_children(int s) const { return n_children_[s]; }
  /// Of the rows below, in the front of the group above.
  std::span<const int> places(int s) const {
    return {places_.data() + first_row_[s] + n_columns(s), places_.data() + first_row_[s + 1]};
  }
  /// Numbers that wait at most, with those of the front that is worked on.
  std::ptrdiff_t most_waiting() const { return most_waiting_; }
  /// Bytes.
  double memory() const { return sizeof(int) * static_cast<double>(n_children_.size() + places_.size()); }

 private:
  const int *super_, *first_row_, *first_entry_, *row_;
  std::vector<int> n_children_, places_;
  std::ptrdiff_t most_waiting_ = 0;
};

/// The elimination of one group after another: K = L L^T, or K = L U without exchanging rows, with ones on the
/// diagonal of U.
///
/// Of the columns of a group the entries of L below the diagonal count, and those of U^T; on the diagonal is
/// one over the entry.
template <class Real>
class Fronts {
 public:
  /// \param[in,out] L, Ut    entries of both: those of a group are those of K and of K^T until it is eliminated.
  ///   Ut = L: K is symmetric
  /// \param[out] waiting  memory for what waits: as many numbers as `most_waiting` says
  /// \param[in] by_blas      larger groups are eliminated by BLAS
  Fronts(const FrontTree& tree, Real* L, Real* Ut, LargeVector<Real>& waiting, bool by_blas);

  /// The columns of a group in L or U^T: as many rows as its front has.
  DenseBlock<Real> columns(int s, Real* entries) const;
  /// Eliminates a group, all below it before. Returns how many of its columns had a pivot that serves: all, or
  /// it has failed. A pivot of a symmetric K has to be above `least`, another one may be any but 0.
  int eliminate(int s, Real least);

 private:
  bool is_symmetric() const { return L_ == Ut_; }
  std::ptrdiff_t square(int s) const {
    return static_cast<std::ptrdiff_t>(tree_.n_below(s)) * tree_.n_below(s);
  }
  void take_from(int child, const Real* from, const DenseBlock<Real>& L, const DenseBlock<Real>& Ut,
                 const DenseBlock<Real>& below) const;

  const FrontTree& tree_;
  Real *L_, *Ut_;
  LargeVector<Real>& waiting_;  ///< a stack of squares; of symmetric ones the lower triangles count
  int few_columns_;             ///< of those that are not
  std::vector<int> groups_;     ///< on the stack
  std::ptrdiff_t top_ = 0;
};

}  // namespace polyfem
