#include <polyfem/assembly/pattern_matrix.hpp>
#include <polyfem/core/out_of_memory.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>

namespace polyfem {
namespace {

/// Calls visit(row, column) for each pair i >= j of each element, j slowest: its place in the lower triangle
/// of the whole, or (-1, -1) when one of the two is left out.
template <class Visit>
void for_each_pair(const Connectivity& connectivity, Visit visit) {
  for (int e = 0; e < connectivity.n_elements(); ++e) {
    const auto rows = connectivity.rows_of(e);
    for (std::size_t j = 0; j < rows.size(); ++j)
      for (std::size_t i = j; i < rows.size(); ++i) {
        const bool kept = rows[i] >= 0 && rows[j] >= 0;
        visit(kept ? std::max(rows[i], rows[j]) : -1, kept ? std::min(rows[i], rows[j]) : -1);
      }
  }
}

/// The rows of each column c, repeated as often as they occur: row[first[c]] .. row[first[c + 1] - 1].
struct Columns {
  std::vector<std::size_t> first;
  std::vector<int> row;
};

Columns collect_columns(int n_rows, const Connectivity& connectivity) {
  Columns columns;
  columns.first.assign(static_cast<std::size_t>(n_rows) + 1, 0);
  for_each_pair(connectivity, [&](int, int column) {
    if (column >= 0) ++columns.first[static_cast<std::size_t>(column) + 1];
  });
  for (std::size_t c = 0; c < static_cast<std::size_t>(n_rows); ++c)
    columns.first[c + 1] += columns.first[c] + 1;  // one more for the diagonal
  columns.row.resize(columns.first.back());

  std::vector<std::size_t> next(columns.first.begin(), columns.first.end() - 1);
  for (int c = 0; c < n_rows; ++c) columns.row[next[static_cast<std::size_t>(c)]++] = c;
  for_each_pair(connectivity, [&](int row, int column) {
    assert(row < n_rows);
    if (column >= 0) columns.row[next[static_cast<std::size_t>(column)]++] = row;
  });
  return columns;
}

SparseMatrix make_pattern(int n_rows, const Connectivity& connectivity) {
  Columns columns = collect_columns(n_rows, connectivity);
  SparseMatrix pattern(n_rows, n_rows);
  auto kept = columns.row.begin();
  for (int c = 0; c < n_rows; ++c) {
    const auto first = columns.row.begin() + static_cast<std::ptrdiff_t>(columns.first[c]);
    const auto last = columns.row.begin() + static_cast<std::ptrdiff_t>(columns.first[c + 1]);
    std::sort(first, last);
    kept = std::unique_copy(first, last, kept);
    if (kept - columns.row.begin() > std::numeric_limits<int>::max())
      throw OutOfMemory("a matrix of " + std::to_string(n_rows) +
                        " rows has more entries than 32-bit indices can count");
    pattern.outerIndexPtr()[c + 1] = static_cast<int>(kept - columns.row.begin());
  }
  pattern.resizeNonZeros(pattern.outerIndexPtr()[n_rows]);
  std::copy(columns.row.begin(), kept, pattern.innerIndexPtr());
  return pattern;
}

/// Where the entry is in the values of a compressed matrix that has it.
int place_of(const SparseMatrix& matrix, int row, int column) {
  const int* rows = matrix.innerIndexPtr();
  const int* outer = matrix.outerIndexPtr();
  return static_cast<int>(std::lower_bound(rows + outer[column], rows + outer[column + 1], row) - rows);
}

}  // namespace

bool PatternMatrix::set_connectivity(int n_rows, const Connectivity& connectivity) {
  if (n_rows == lower_.rows() && connectivity == connectivity_) return false;
  connectivity_ = connectivity;
  lower_ = make_pattern(n_rows, connectivity);
  set_zero();
  place_.clear();
  for_each_pair(connectivity, [&](int row, int column) {
    place_.push_back(column < 0 ? -1 : place_of(lower_, row, column));
  });
  first_place_.assign(1, 0);
  for (int e = 0; e < connectivity.n_elements(); ++e) {
    const std::size_t k = connectivity.rows_of(e).size();
    first_place_.push_back(first_place_.back() + k * (k + 1) / 2);
  }
  return true;
}

void PatternMatrix::set_zero() {
  std::fill_n(lower_.valuePtr(), lower_.nonZeros(), 0.);
}

void PatternMatrix::set_identity() {
  set_zero();
  for (int c = 0; c < lower_.cols(); ++c) lower_.valuePtr()[lower_.outerIndexPtr()[c]] = 1;
}

// A pair i > j stands for the entries (i, j) and (j, i) of the element. They fall on (r, c) and (c, r), of
// which only the lower one is stored, unless both rows are the same: then both fall on the diagonal.

void PatternMatrix::add(int element, const Eigen::Ref<const MatrixXd>& matrix) {
  const auto rows = connectivity_.rows_of(element);
  const Index k = static_cast<Index>(rows.size());
  assert(matrix.rows() == k && matrix.cols() == k);
  const int* place = place_.data() + first_place_[static_cast<std::size_t>(element)];
  double* values = lower_.valuePtr();
  for (Index j = 0; j < k; ++j)
    for (Index i = j; i < k; ++i, ++place)
      if (*place >= 0) values[*place] += i != j && rows[i] == rows[j] ? 2 * matrix(i, j) : matrix(i, j);
}

void PatternMatrix::add_outer(int element, double factor, std::span<const double> a) {
  const auto rows = connectivity_.rows_of(element);
  assert(a.size() == rows.size());
  const int* place = place_.data() + first_place_[static_cast<std::size_t>(element)];
  double* values = lower_.valuePtr();
  for (std::size_t j = 0; j < a.size(); ++j)
    for (std::size_t i = j; i < a.size(); ++i, ++place)
      if (*place >= 0) values[*place] += (i != j && rows[i] == rows[j] ? 2 * factor : factor) * a[i] * a[j];
}

double PatternMatrix::memory() const {
  const auto bytes = [](const auto& numbers) {
    return static_cast<double>(numbers.capacity() * sizeof(numbers[0]));
  };
  return bytes(connectivity_.first) + bytes(connectivity_.rows) + bytes(first_place_) + bytes(place_) +
         static_cast<double>(lower_.data().allocatedSize()) *
             (sizeof(double) + sizeof(SparseMatrix::StorageIndex)) +
         static_cast<double>(lower_.outerSize()) * sizeof(SparseMatrix::StorageIndex);
}

}  // namespace polyfem
