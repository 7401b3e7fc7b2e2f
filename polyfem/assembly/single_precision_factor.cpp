#include <polyfem/assembly/single_precision_factor.hpp>

#include <cholmod.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <span>

extern "C" {
void ssyrk_(const char*, const char*, const int*, const int*, const float*, const float*, const int*,
            const float*, float*, const int*);
void sgemm_(const char*, const char*, const int*, const int*, const int*, const float*, const float*,
            const int*, const float*, const int*, const float*, float*, const int*);
void strsm_(const char*, const char*, const char*, const char*, const int*, const int*, const float*,
            const float*, const int*, float*, const int*);
}

namespace polyfem {
namespace {

/// Fewer columns are quicker by plain loops than by BLAS; as many are eliminated one by one on the diagonal.
constexpr int few_columns = 8, columns_at_once = 32;

/// In so many parts entries wait for their columns.
constexpr int n_parts = 16;

/// A block of a matrix stored by columns.
struct Block {
  float* first;
  int n_rows, n_columns, stride;

  Block below(int row, int column) const {
    return {first + static_cast<std::ptrdiff_t>(column) * stride + row, n_rows - row, n_columns - column,
            stride};
  }
  Block columns(int n) const { return {first, n_rows, n, stride}; }
  Block rows(int n) const { return {first, n, n_columns, stride}; }
  Eigen::Map<Eigen::VectorXf> column(int c, int row) const {
    return {first + static_cast<std::ptrdiff_t>(c) * stride + row, n_rows - row};
  }
  float at(int row, int column) const { return first[static_cast<std::ptrdiff_t>(column) * stride + row]; }
};

/// C -= A A^T below the diagonal, C as many columns of it as it has.
void subtract_square(const Block& A, const Block& C) {
  if (A.n_columns < few_columns) {
    for (int c = 0; c < C.n_columns; ++c) {
      auto target = C.column(c, c);
      int k = 0;
      for (; k + 1 < A.n_columns; k += 2)
        target -= A.at(c, k) * A.column(k, c) + A.at(c, k + 1) * A.column(k + 1, c);
      if (k < A.n_columns) target -= A.at(c, k) * A.column(k, c);
    }
    return;
  }
  const float minus = -1, one = 1;
  ssyrk_("L", "N", &C.n_columns, &A.n_columns, &minus, A.first, &A.stride, &one, C.first, &C.stride);
  const Block rest = C.below(C.n_columns, 0);
  if (rest.n_rows > 0)
    sgemm_("N", "T", &rest.n_rows, &rest.n_columns, &A.n_columns, &minus, A.first + C.n_columns, &A.stride,
           A.first, &A.stride, &one, rest.first, &rest.stride);
}

/// Eliminates the columns, one by one.
bool eliminate_one_by_one(const Block& block) {
  static const float least = std::sqrt(std::numeric_limits<float>::epsilon());
  for (int c = 0; c < block.n_columns; ++c) {
    const float pivot = block.at(c, c);
    if (!(pivot > least)) return false;
    block.column(c, c) /= std::sqrt(pivot);
    for (int d = c + 1; d < block.n_columns; ++d) block.column(d, d) -= block.at(d, c) * block.column(c, d);
  }
  return true;
}

/// Columns of L in place of the columns of a front.
bool eliminate(const Block& block) {
  const int n = block.n_columns;
  if (n < few_columns) return eliminate_one_by_one(block);
  if (n <= columns_at_once) {
    if (!eliminate_one_by_one(block.rows(n))) return false;
    const Block rest = block.below(n, 0);
    const float one = 1;
    if (rest.n_rows > 0)
      strsm_("R", "L", "T", "N", &rest.n_rows, &n, &one, block.first, &block.stride, rest.first,
             &rest.stride);
    return true;
  }
  const int left = (n / 2 + columns_at_once - 1) / columns_at_once * columns_at_once;
  const Block first = block.columns(left), second = block.below(left, left);
  if (!eliminate(first)) return false;
  subtract_square(first.below(left, 0), second);
  return eliminate(second);
}

/// An entry of S K S in its row of L.
struct Entry {
  int row;
  float value;
};

/// Those of each column of L, in parts of columns that follow each other: parts that are used are let go, as
/// L takes their memory.
struct Entries {
  std::vector<int> first;  ///< of column c in all of them
  int part_size;           ///< columns
  std::vector<LargeVector<Entry>> parts;

  std::span<Entry> of_column(int c) {
    const int part = c / part_size;
    return {parts[part].data() + (first[c] - first[part * part_size]),
            static_cast<std::size_t>(first[c + 1] - first[c])};
  }
  void forget_before(int c) {
    for (int part = c / part_size - 1; part >= 0 && !parts[part].empty(); --part)
      LargeVector<Entry>().swap(parts[part]);
  }
};

/// One over the roots of the diagonal; nothing when an entry of it is not positive.
std::optional<VectorXd> scale_of(const SparseMatrix& lower) {
  VectorXd scale(lower.cols());
  for (Index c = 0; c < lower.cols(); ++c) {
    const double diagonal = lower.valuePtr()[lower.outerIndexPtr()[c]];
    if (!(diagonal > 0)) return std::nullopt;
    scale[c] = 1 / std::sqrt(diagonal);
  }
  return scale;
}

Entries in_order(const cholmod_factor_struct& L, const SparseMatrix& lower, const VectorXd& scale) {
  const int n = static_cast<int>(L.n);
  const int *const order = static_cast<const int*>(L.Perm), *const outer = lower.outerIndexPtr(),
                   *const inner = lower.innerIndexPtr();
  std::vector<int> place(L.n);
  for (int k = 0; k < n; ++k) place[order[k]] = k;
  Entries sorted{std::vector<int>(L.n + 1, 0), (n + n_parts - 1) / n_parts, {}};
  std::vector<int>& first = sorted.first;
  for (int c = 0; c < n; ++c)
    for (int slot = outer[c]; slot < outer[c + 1]; ++slot)
      ++first[std::min(place[c], place[inner[slot]]) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (int c = 0; c < n; c += sorted.part_size)
    sorted.parts.emplace_back(static_cast<std::size_t>(first[std::min(c + sorted.part_size, n)] - first[c]));
  std::vector<int> n_found(L.n, 0);
  for (int c = 0; c < n; ++c)
    for (int slot = outer[c]; slot < outer[c + 1]; ++slot) {
      const auto [column, row] = std::minmax({place[c], place[inner[slot]]});
      sorted.of_column(column)[static_cast<std::size_t>(n_found[column]++)] = {
          row, static_cast<float>(lower.valuePtr()[slot] * scale[c] * scale[inner[slot]])};
    }
  return sorted;
}

/// The elimination of one group after another. What groups pass up to others lies on a stack: groups are in
/// postorder, so that what a group takes is on top.
class Fronts {
 public:
  Fronts(const cholmod_factor_struct& L, LargeVector<float>& entries)
      : super_(static_cast<const int*>(L.super)),
        first_row_(static_cast<const int*>(L.pi)),
        first_entry_(static_cast<const int*>(L.px)),
        row_(static_cast<const int*>(L.s)),
        entries_(entries),
        place_(L.n),
        children_(L.nsuper) {
    const int n_groups = static_cast<int>(L.nsuper);
    std::vector<int> group_of(L.n);
    for (int s = 0; s < n_groups; ++s)
      std::fill(group_of.begin() + super_[s], group_of.begin() + super_[s + 1], s);
    for (int s = 0; s < n_groups; ++s)
      if (n_below(s) > 0) ++children_[group_of[row_below(s)[0]]];
    std::ptrdiff_t size = 0, largest_size = 0;
    for (int s = 0; s < n_groups; ++s) {
      largest_size = std::max(largest_size, size + square(s));
      for (int k = 0; k < children_[s]; ++k) pop(size);
      if (n_below(s) > 0) push(s, size);
    }
    stack_.resize(static_cast<std::size_t>(largest_size));
  }

  bool eliminate_group(int s, Entries& K) {
    const int n_columns = super_[s + 1] - super_[s], n_rows = n_columns + n_below(s);
    const int* const row = row_ + first_row_[s];
    const Block columns{entries_.data() + first_entry_[s], n_rows, n_columns, n_rows};
    float* const top = stack_.data() + top_;
    std::fill_n(top, square(s), 0.f);
    const Block below{top, n_below(s), n_below(s), n_below(s)};

    for (int k = 0; k < n_rows; ++k) place_[row[k]] = k;
    for (int c = 0; c < n_columns; ++c)
      for (const Entry& entry : K.of_column(super_[s] + c))
        columns.first[static_cast<std::ptrdiff_t>(c) * n_rows + place_[entry.row]] = entry.value;
    K.forget_before(super_[s]);
    for (int k = 0; k < children_[s]; ++k) {
      const int child = pop(top_);
      take_from(child, stack_.data() + top_, columns, below);
    }

    if (!eliminate(columns)) return false;
    if (n_below(s) == 0) return true;
    subtract_square(columns.below(n_columns, 0), below);
    std::copy_n(top, square(s), stack_.data() + top_);
    push(s, top_);
    return true;
  }

 private:
  int n_below(int s) const { return first_row_[s + 1] - first_row_[s] - (super_[s + 1] - super_[s]); }
  const int* row_below(int s) const { return row_ + first_row_[s] + (super_[s + 1] - super_[s]); }
  std::ptrdiff_t square(int s) const { return static_cast<std::ptrdiff_t>(n_below(s)) * n_below(s); }

  void push(int s, std::ptrdiff_t& size) {
    on_stack_.push_back(s);
    size += square(s);
  }
  int pop(std::ptrdiff_t& size) {
    const int s = on_stack_.back();
    on_stack_.pop_back();
    size -= square(s);
    return s;
  }

  /// Adds what a child has passed up to the columns of the group and to what the group passes up itself.
  void take_from(int child, const float* from, const Block& columns, const Block& below) {
    const int* const row = row_below(child);
    const int n = n_below(child);
    places_.resize(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) places_[k] = place_[row[k]];
    for (int j = 0; j < n; ++j, from += n) {
      const int c = places_[j];
      const bool is_own = c < columns.n_columns;
      float* const to = is_own
                            ? columns.first + static_cast<std::ptrdiff_t>(c) * columns.stride
                            : below.first + static_cast<std::ptrdiff_t>(c - columns.n_columns) * below.stride;
      const int shift = is_own ? 0 : columns.n_columns;
      for (int i = j; i < n; ++i) to[places_[i] - shift] += from[i];
    }
  }

  const int *super_, *first_row_, *first_entry_, *row_;
  LargeVector<float>& entries_;
  std::vector<int> place_;     ///< of a row in the front
  std::vector<int> places_;    ///< of the rows of a child
  std::vector<int> children_;  ///< how many groups pass up to each one
  std::vector<int> on_stack_;  ///< groups, each with a square of which the lower triangle counts
  LargeVector<float> stack_;
  std::ptrdiff_t top_ = 0;  ///< of the stack
};

}  // namespace

std::optional<SinglePrecisionFactor> single_precision_factor(const cholmod_factor_struct& groups,
                                                             const SparseMatrix& lower) {
  std::optional<VectorXd> scale = scale_of(lower);
  if (!scale) return std::nullopt;
  SinglePrecisionFactor factor{std::move(*scale), LargeVector<float>(groups.xsize)};
  Entries K = in_order(groups, lower, factor.scale);
  Fronts fronts(groups, factor.entries);
  for (int s = 0; s < static_cast<int>(groups.nsuper); ++s)
    if (!fronts.eliminate_group(s, K)) return std::nullopt;
  return factor;
}

}  // namespace polyfem
