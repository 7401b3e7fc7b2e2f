#include <polyfem/assembly/pattern_matrix.hpp>
#include <polyfem/core/out_of_memory.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace polyfem {
namespace {

/// The groups of rows at and below the diagonal of the columns of each group: found one after another. A
/// group is told by its first row.
class ColumnGroups {
 public:
  ColumnGroups(int n_groups, int size, const Connectivity& groups)
      : size_(size),
        first_(static_cast<std::size_t>(n_groups) + 1, 0),
        seen_in_(static_cast<std::size_t>(n_groups), -1) {
    for (int row : groups.rows)
      if (row >= 0) ++first_[number(row) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    elements_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (int e = 0; e < groups.n_elements(); ++e)
      for (int row : groups.rows_of(e)) {
        assert(number(row) < next.size() || row < 0);
        if (row >= 0) elements_[next[number(row)]++] = groups.rows_of(e);
      }
  }

  /// Whether the group is in any element.
  bool occurs(int column) const { return first_[number(column)] < first_[number(column) + 1]; }
  /// Writes those of a column, ascending.
  void find(int column, std::vector<int>& rows) {
    rows.assign(1, column);
    seen_in_[number(column)] = column;
    for (std::size_t k = first_[number(column)]; k < first_[number(column) + 1]; ++k)
      for (int row : elements_[k]) {
        if (row < column || seen_in_[number(row)] == column) continue;
        seen_in_[number(row)] = column;
        rows.push_back(row);
      }
    std::sort(rows.begin(), rows.end());
  }

 private:
  std::size_t number(int row) const { return static_cast<std::size_t>(row / size_); }

  int size_;
  std::vector<std::size_t> first_;              ///< of each group in elements_
  std::vector<std::span<const int>> elements_;  ///< the groups of those that a group is in
  std::vector<int> seen_in_;                    ///< of each group the last column that has it
};

SparseMatrix make_pattern(int n_rows, int size, const Connectivity& groups) {
  const int n_groups = n_rows / size;
  ColumnGroups columns(n_groups, size, groups);
  std::vector<int> rows, found, first{0};
  const auto end_column = [&] {
    if (rows.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw OutOfMemory("a matrix of " + std::to_string(n_rows) +
                        " rows has more entries than 32-bit indices can count");
    first.push_back(static_cast<int>(rows.size()));
  };
  for (int column = 0; column < n_rows; ++column) {
    const int group = column - column % size;
    if (group >= size * n_groups || !columns.occurs(group)) {
      rows.push_back(column);
      end_column();
      continue;
    }
    if (column == group) columns.find(group, found);
    for (int row : found)
      for (int k = std::max(row, column); k < row + size; ++k) rows.push_back(k);
    end_column();
  }
  SparseMatrix pattern(n_rows, n_rows);
  pattern.resizeNonZeros(first.back());
  std::copy(first.begin(), first.end(), pattern.outerIndexPtr());
  std::copy(rows.begin(), rows.end(), pattern.innerIndexPtr());
  return pattern;
}

bool have_same_pattern(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

/// Where the entry is in the values of a compressed matrix that has it.
/// \param[in] guess  a place, looked at first
int place_of(const SparseMatrix& matrix, int row, int column, int guess) {
  const int* rows = matrix.innerIndexPtr();
  const int* outer = matrix.outerIndexPtr();
  if (guess >= outer[column] && guess < outer[column + 1] && rows[guess] == row) return guess;
  return static_cast<int>(std::lower_bound(rows + outer[column], rows + outer[column + 1], row) - rows);
}

/// Of every two of the rows of every element, the later one fastest, the slot of their entry in the lower
/// triangle; -1 when one of the two is left out.
/// \param[in] stride  between slots that may follow each other
void find_slots(const Connectivity& elements, const SparseMatrix& lower, int stride, std::vector<int>& slot) {
  slot.clear();
  for (int e = 0; e < elements.n_elements(); ++e) {
    const auto rows = elements.rows_of(e);
    for (std::size_t j = 0; j < rows.size(); ++j) {
      int last = -1;
      for (std::size_t i = j; i < rows.size(); ++i) {
        const bool kept = rows[i] >= 0 && rows[j] >= 0;
        slot.push_back(
            kept ? place_of(lower, std::max(rows[i], rows[j]), std::min(rows[i], rows[j]), last + stride)
                 : -1);
        last = slot.back();
      }
    }
  }
}

/// Whether the rows of all elements come in groups of so many, a multiple of it and the next ones, none of
/// more than one row twice in an element; of each the first row goes to `groups`, -1 for one that is left
/// out.
bool comes_in_groups(const Connectivity& connectivity, int size, Connectivity& groups) {
  const auto n = static_cast<std::size_t>(size);
  groups.clear();
  for (int e = 0; e < connectivity.n_elements(); ++e) {
    const auto rows = connectivity.rows_of(e);
    if (rows.size() % n != 0) return false;
    const std::size_t begin = groups.rows.size();
    for (std::size_t k = 0; k < rows.size(); k += n) {
      const bool left_out = rows[k] < 0;
      if (!left_out && rows[k] % size != 0) return false;
      for (std::size_t l = 1; l < n; ++l)
        if (left_out ? rows[k + l] >= 0 : rows[k + l] != rows[k + l - 1] + 1) return false;
      const auto before = groups.rows.begin() + static_cast<std::ptrdiff_t>(begin);
      if (size > 1 && !left_out && std::find(before, groups.rows.end(), rows[k]) != groups.rows.end())
        return false;
      groups.rows.push_back(left_out ? -1 : rows[k]);
    }
    groups.first.push_back(static_cast<int>(groups.rows.size()));
  }
  return true;
}

}  // namespace

bool PatternMatrix::is_of(const Connectivity& connectivity) const {
  const auto size = static_cast<std::size_t>(group_size_);
  if (connectivity.rows.size() != size * groups_.rows.size() ||
      connectivity.first.size() != groups_.first.size())
    return false;
  for (std::size_t e = 0; e < groups_.first.size(); ++e)
    if (connectivity.first[e] != group_size_ * groups_.first[e]) return false;
  const int* row = connectivity.rows.data();
  for (const int first : groups_.rows)
    for (int l = 0; l < group_size_; ++l, ++row)
      if (first < 0 ? *row >= 0 : *row != first + l) return false;
  return true;
}

bool PatternMatrix::set_connectivity(int n_rows, const Connectivity& connectivity) {
  if (n_rows == lower_.rows() && is_of(connectivity)) return false;
  Connectivity groups;
  int size = 3;
  while (!comes_in_groups(connectivity, size, groups)) --size;
  groups.first.shrink_to_fit();
  groups.rows.shrink_to_fit();
  SparseMatrix pattern = make_pattern(n_rows, size, groups);
  std::vector<std::size_t> first_slot(static_cast<std::size_t>(groups.n_elements()) + 1, 0);
  for (int e = 0; e < groups.n_elements(); ++e) {
    const std::size_t k = groups.rows_of(e).size();
    first_slot[static_cast<std::size_t>(e) + 1] = first_slot[static_cast<std::size_t>(e)] + k * (k + 1) / 2;
  }
  std::vector<int> slot = std::move(slot_);  // its memory serves again
  group_size_ = 0;                           // of no connectivity, should memory not suffice for these
  slot.reserve(first_slot.back());
  find_slots(groups, pattern, size, slot);
  const bool changed = !have_same_pattern(pattern, lower_);
  if (changed) lower_ = std::move(pattern);
  group_size_ = size;
  groups_ = std::move(groups);
  first_slot_ = std::move(first_slot);
  slot_ = std::move(slot);
  set_zero();
  return changed;
}

void PatternMatrix::set_zero() {
  std::fill_n(lower_.valuePtr(), lower_.nonZeros(), 0.);
  more_above_.resize(0);
}

void PatternMatrix::set_identity() {
  set_zero();
  for (int c = 0; c < lower_.cols(); ++c) lower_.valuePtr()[lower_.outerIndexPtr()[c]] = 1;
}

// Two rows i, j of an element stand for the entries (i, j) and (j, i). They fall on (r, c) and (c, r), of
// which only the lower one is stored, unless both rows are the same: then both fall on the diagonal.

template <int size, class Entry>
void PatternMatrix::add_groups(int element, const Entry& entry, double* values) {
  const auto groups = groups_.rows_of(element);
  const int n = static_cast<int>(groups.size());
  const int* slot = slot_.data() + first_slot_[static_cast<std::size_t>(element)];
  const int* outer = lower_.outerIndexPtr();
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i, ++slot) {
      if (*slot < 0) continue;
      const auto first = [&](int group) { return groups[static_cast<std::size_t>(group)]; };
      const int row = first(i) >= first(j) ? i : j, column = i + j - row;
      for (int l = 0; l < size; ++l) {
        // A column of a group lacks the top of the one before.
        double* const top =
            values + *slot + (l > 0 ? outer[first(column) + l] - outer[first(column)] - l : 0);
        for (int k = i == j ? l : 0; k < size; ++k) top[k] += entry(size * row + k, size * column + l);
      }
      if (size == 1 && i != j && first(i) == first(j)) values[*slot] += entry(column, row);
    }
}

template <class Entry>
void PatternMatrix::add_entries(int element, const Entry& entry, double* values) {
  switch (group_size_) {
    case 3:
      return add_groups<3>(element, entry, values);
    case 2:
      return add_groups<2>(element, entry, values);
    default:
      return add_groups<1>(element, entry, values);
  }
}

void PatternMatrix::add(int element, const Eigen::Ref<const MatrixXd>& matrix) {
  assert(matrix.rows() == group_size_ * static_cast<Index>(groups_.rows_of(element).size()) &&
         matrix.cols() == matrix.rows());
  add_entries(
      element, [&](int i, int j) { return matrix(i, j); }, lower_.valuePtr());
}

void PatternMatrix::add_outer(int element, double factor, std::span<const double> a) {
  assert(a.size() == static_cast<std::size_t>(group_size_) * groups_.rows_of(element).size());
  add_entries(
      element, [factor, a = a.data()](int i, int j) { return factor * a[i] * a[j]; }, lower_.valuePtr());
}

void PatternMatrix::add_outer(int element, double factor, std::span<const double> a,
                              std::span<const double> b) {
  assert(a.size() == b.size() &&
         a.size() == static_cast<std::size_t>(group_size_) * groups_.rows_of(element).size());
  if (more_above_.size() == 0) more_above_.setZero(lower_.nonZeros());
  const double *const x = a.data(), *const y = b.data();
  add_entries(
      element, [=](int i, int j) { return factor * x[i] * y[j]; }, lower_.valuePtr());
  add_entries(
      element, [=](int i, int j) { return factor * (x[j] * y[i] - x[i] * y[j]); }, more_above_.data());
}

double PatternMatrix::memory() const {
  const auto bytes = [](const auto& numbers) {
    return static_cast<double>(numbers.capacity() * sizeof(numbers[0]));
  };
  return bytes(groups_.first) + sizeof(double) * static_cast<double>(more_above_.size()) +
         bytes(groups_.rows) + bytes(first_slot_) + bytes(slot_) +
         static_cast<double>(lower_.data().allocatedSize()) *
             (sizeof(double) + sizeof(SparseMatrix::StorageIndex)) +
         static_cast<double>(lower_.outerSize()) * sizeof(SparseMatrix::StorageIndex);
}

}  // namespace polyfem
