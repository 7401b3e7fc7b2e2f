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

/// Of every pair i >= j of the rows of every element, both multiples of `stride`, j slowest, the place of its
/// entry in the lower triangle; -1 when one of the two is left out.
void find_places(const Connectivity& elements, const SparseMatrix& lower, std::size_t stride,
                 std::vector<int>& place) {
  place.clear();
  for (int e = 0; e < elements.n_elements(); ++e) {
    const auto rows = elements.rows_of(e);
    for (std::size_t j = 0; j < rows.size(); j += stride) {
      int last = -1;
      for (std::size_t i = j; i < rows.size(); i += stride) {
        const bool kept = rows[i] >= 0 && rows[j] >= 0;
        place.push_back(kept ? place_of(lower, std::max(rows[i], rows[j]), std::min(rows[i], rows[j]),
                                        last + static_cast<int>(stride))
                             : -1);
        last = place.back();
      }
    }
  }
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
  SparseMatrix pattern = make_pattern(n_rows, connectivity);
  const bool changed = !have_same_pattern(pattern, lower_);
  if (changed) lower_ = std::move(pattern);
  connectivity_ = connectivity;
  set_zero();
  paired_ = comes_in_pairs(connectivity);
  const std::size_t stride = paired_ ? 2 : 1;
  first_place_.assign(static_cast<std::size_t>(connectivity.n_elements()) + 1, 0);
  for (int e = 0; e < connectivity.n_elements(); ++e) {
    const std::size_t k = connectivity.rows_of(e).size() / stride;
    first_place_[static_cast<std::size_t>(e) + 1] =
        first_place_[static_cast<std::size_t>(e)] + k * (k + 1) / 2;
  }
  place_.reserve(first_place_.back());
  find_places(connectivity, lower_, stride, place_);
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
