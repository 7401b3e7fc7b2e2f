#include <polyfem/assembly/pattern_matrix.hpp>
#include <polyfem/core/out_of_memory.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>

namespace polyfem {
namespace {

/// Calls visit(row, column) for each pair i >= j of each element, both multiples of `stride`, j slowest: its
/// place in the lower triangle of the whole, or (-1, -1) when one of the two is left out.
template <class Visit>
void for_each_pair(const Connectivity& connectivity, std::size_t stride, Visit visit) {
  for (int e = 0; e < connectivity.n_elements(); ++e) {
    const auto rows = connectivity.rows_of(e);
    for (std::size_t j = 0; j < rows.size(); j += stride)
      for (std::size_t i = j; i < rows.size(); i += stride) {
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
  for_each_pair(connectivity, 1, [&](int, int column) {
    if (column >= 0) ++columns.first[static_cast<std::size_t>(column) + 1];
  });
  for (std::size_t c = 0; c < static_cast<std::size_t>(n_rows); ++c)
    columns.first[c + 1] += columns.first[c] + 1;  // one more for the diagonal
  columns.row.resize(columns.first.back());

  std::vector<std::size_t> next(columns.first.begin(), columns.first.end() - 1);
  for (int c = 0; c < n_rows; ++c) columns.row[next[static_cast<std::size_t>(c)]++] = c;
  for_each_pair(connectivity, 1, [&](int row, int column) {
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

/// Whether all elements have their rows two by two, an even one and the next, none twice.
bool comes_in_pairs(const Connectivity& connectivity) {
  for (int e = 0; e < connectivity.n_elements(); ++e) {
    const auto rows = connectivity.rows_of(e);
    if (rows.size() % 2 != 0) return false;
    for (std::size_t k = 0; k < rows.size(); k += 2) {
      const bool left_out = rows[k] < 0 && rows[k + 1] < 0;
      if (!left_out && (rows[k] < 0 || rows[k] % 2 != 0 || rows[k + 1] != rows[k] + 1)) return false;
      for (std::size_t l = 0; l < k; l += 2)
        if (!left_out && rows[l] == rows[k]) return false;
    }
  }
  return true;
}

}  // namespace

bool PatternMatrix::set_connectivity(int n_rows, const Connectivity& connectivity) {
  if (n_rows == lower_.rows() && connectivity == connectivity_) return false;
  connectivity_ = connectivity;
  lower_ = make_pattern(n_rows, connectivity);
  set_zero();
  paired_ = comes_in_pairs(connectivity);
  const std::size_t stride = paired_ ? 2 : 1;
  first_place_.assign(static_cast<std::size_t>(connectivity.n_elements()) + 1, 0);
  for (int e = 0; e < connectivity.n_elements(); ++e) {
    const std::size_t k = connectivity.rows_of(e).size() / stride;
    first_place_[static_cast<std::size_t>(e) + 1] =
        first_place_[static_cast<std::size_t>(e)] + k * (k + 1) / 2;
  }
  place_.resize(first_place_.back());
  auto place = place_.begin();
  for_each_pair(connectivity, stride,
                [&](int row, int column) { *place++ = column < 0 ? -1 : place_of(lower_, row, column); });
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

template <class Visit>
void PatternMatrix::for_places(int element, const Visit& visit) const {
  const auto rows = connectivity_.rows_of(element);
  const std::size_t k = rows.size();
  const int* place = place_.data() + first_place_[static_cast<std::size_t>(element)];
  if (!paired_) {
    for (std::size_t j = 0; j < k; ++j)
      for (std::size_t i = j; i < k; ++i, ++place)
        if (*place >= 0) visit(i, j, *place);
    return;
  }
  const int* outer = lower_.outerIndexPtr();
  for (std::size_t j = 0; j < k; j += 2)
    for (std::size_t i = j; i < k; i += 2, ++place) {
      if (*place < 0) continue;
      const int column = std::min(rows[i], rows[j]);
      const int right =
          *place + outer[column + 1] - outer[column] - 1;  // in the next column, without its top
      visit(i, j, *place);
      if (i == j) {
        visit(i + 1, j, *place + 1);
        visit(i + 1, j + 1, right + 1);
        continue;
      }
      const bool below = rows[i] > rows[j];
      visit(i + 1, j, below ? *place + 1 : right);
      visit(i, j + 1, below ? right : *place + 1);
      visit(i + 1, j + 1, right + 1);
    }
}

void PatternMatrix::add(int element, const Eigen::Ref<const MatrixXd>& matrix) {
  const auto rows = connectivity_.rows_of(element);
  assert(matrix.rows() == static_cast<Index>(rows.size()) && matrix.cols() == matrix.rows());
  double* values = lower_.valuePtr();
  for_places(element, [&](std::size_t i, std::size_t j, int place) {
    const double entry = matrix(static_cast<Index>(i), static_cast<Index>(j));
    values[place] += i != j && rows[i] == rows[j] ? 2 * entry : entry;
  });
}

void PatternMatrix::add_outer(int element, double factor, std::span<const double> a) {
  const auto rows = connectivity_.rows_of(element);
  assert(a.size() == rows.size());
  double* values = lower_.valuePtr();
  for_places(element, [&](std::size_t i, std::size_t j, int place) {
    values[place] += (i != j && rows[i] == rows[j] ? 2 * factor : factor) * a[i] * a[j];
  });
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
