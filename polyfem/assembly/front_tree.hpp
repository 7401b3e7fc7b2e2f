/// \file The pattern of a factor whose columns come in groups, and which group passes up to which.
#pragma once

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

/// The groups of columns of L that have the same rows below the block on their diagonal, as CHOLMOD found
/// them. Columns and rows are in the order of elimination, groups in postorder. A group and the rows below it
/// are its front, which passes up to the group of the first of these rows.
class FrontTree {
 public:
  /// \param[in] L  supernodal and analyzed; it has to live as long
  explicit FrontTree(const cholmod_factor_struct& L);

  int n_rows() const { return static_cast<int>(group_of_.size()); }
  /// Of the matrix, the row that is eliminated k-th.
  int original_row(int k) const { return order_[k]; }

  int n_groups() const { return static_cast<int>(n_children_.size()); }
  int group_of(int column) const { return group_of_[column]; }
  int first_column(int s) const { return super_[s]; }
  int n_columns(int s) const { return super_[s + 1] - super_[s]; }
  /// Of the front: those of its columns and those below. The rows of all fronts follow each other, those of a
  /// group from `first_row` on.
  std::span<const int> rows(int s) const { return {row_ + first_row(s), row_ + first_row(s + 1)}; }
  int first_row(int s) const { return first_row_[s]; }
  int n_below(int s) const { return first_row(s + 1) - first_row(s) - n_columns(s); }

  /// The group that it passes up to; -1: nothing is below.
  int above(int s) const { return n_below(s) == 0 ? -1 : group_of(rows(s)[n_columns(s)]); }
  /// Groups that pass up to this one.
  int n_children(int s) const { return n_children_[s]; }
  /// Of the rows below, in the front of the group above.
  std::span<const int> places(int s) const {
    return {places_.data() + first_row(s) + n_columns(s), places_.data() + first_row(s + 1)};
  }

  std::size_t n_entries() const { return n_entries_; }
  /// The columns of a group among the entries of L: as many rows as its front has.
  template <class Real>
  DenseBlock<Real> columns(int s, Real* entries) const {
    const int n_rows = first_row(s + 1) - first_row(s);
    return {entries + first_entry_[s], n_rows, n_columns(s), n_rows};
  }
  /// Where an entry at or below the diagonal is among those of L.
  std::ptrdiff_t place_of(int row, int column) const;

  /// Numbers that wait at most for the groups above, with those of the front that is worked on.
  std::ptrdiff_t most_waiting() const { return most_waiting_; }
  /// Bytes.
  double memory() const;

 private:
  const int *super_, *first_row_, *first_entry_, *row_, *order_;
  std::size_t n_entries_;
  std::vector<int> group_of_, n_children_, places_;
  std::ptrdiff_t most_waiting_ = 0;
};

}  // namespace polyfem
