#include <polyfem/assembly/pattern_matrix.hpp>
#include <polyfem/core/out_of_memory.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <string>

namespace polyfem {
namespace {

/// The rows at and below the diagonal of the columns 0, 1, ...: found one column after another.
class ColumnRows {
 public:
  ColumnRows(int n_rows, const Connectivity& connectivity)
      : first_(static_cast<std::size_t>(n_rows) + 1, 0), seen_in_(static_cast<std::size_t>(n_rows), -1) {
    for (int row : connectivity.rows)
      if (row >= 0) ++first_[static_cast<std::size_t>(row) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    elements_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (int e = 0; e < connectivity.n_elements(); ++e)
      for (int row : connectivity.rows_of(e)) {
        assert(row < n_rows);
        if (row >= 0) elements_[next[static_cast<std::size_t>(row)]++] = connectivity.rows_of(e);
      }
  }

  /// Appends those of a column, ascending.
  void append(int column, std::vector<int>& rows) {
    const auto begin = static_cast<std::ptrdiff_t>(rows.size());
    rows.push_back(column);
    seen_in_[static_cast<std::size_t>(column)] = column;
    for (std::size_t k = first_[static_cast<std::size_t>(column)];
         k < first_[static_cast<std::size_t>(column) + 1]; ++k)
      for (int row : elements_[k]) {
        if (row < column || seen_in_[static_cast<std::size_t>(row)] == column) continue;
        seen_in_[static_cast<std::size_t>(row)] = column;
        rows.push_back(row);
      }
    std::sort(rows.begin() + begin, rows.end());
  }

 private:
  std::vector<std::size_t> first_;              ///< of each row in elements_
  std::vector<std::span<const int>> elements_;  ///< the rows of those that a row is in
  std::vector<int> seen_in_;                    ///< of each row the last column that has it
};

SparseMatrix make_pattern(int n_rows, const Connectivity& connectivity) {
  ColumnRows columns(n_rows, connectivity);
  std::vector<int> rows, first{0};
  for (int c = 0; c < n_rows; ++c) {
    columns.append(c, rows);
    if (rows.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw OutOfMemory("a matrix of " + std::to_string(n_rows) +
                        " rows has more entries than 32-bit indices can count");
    first.push_back(static_cast<int>(rows.size()));
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

/// Of every pair i >= j of the rows of every element, j slowest, the place of its entry in the lower
/// triangle; -1 when one of the two is left out.
void find_places(const Connectivity& elements, const SparseMatrix& lower, std::vector<int>& place) {
  place.clear();
  for (int e = 0; e < elements.n_elements(); ++e) {
    const auto rows = elements.rows_of(e);
    for (std::size_t j = 0; j < rows.size(); ++j) {
      int last = -1;
      for (std::size_t i = j; i < rows.size(); ++i) {
        const bool kept = rows[i] >= 0 && rows[j] >= 0;
        place.push_back(
            kept ? place_of(lower, std::max(rows[i], rows[j]), std::min(rows[i], rows[j]), last + 1) : -1);
        last = place.back();
      }
    }
  }
}

}  // namespace

bool PatternMatrix::set_connectivity(int n_rows, const Connectivity& connectivity) {
  if (n_rows == lower_.rows() && connectivity == connectivity_) return false;
  SparseMatrix pattern = make_pattern(n_rows, connectivity);
  const bool changed = !have_same_pattern(pattern, lower_);
  if (changed) lower_ = std::move(pattern);
  connectivity_ = connectivity;
  set_zero();
  find_places(connectivity, lower_, place_);
  first_place_.assign(1, 0);
  for (int e = 0; e < connectivity.n_elements(); ++e) {
    const std::size_t k = connectivity.rows_of(e).size();
    first_place_.push_back(first_place_.back() + k * (k + 1) / 2);
  }
  return changed;
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
