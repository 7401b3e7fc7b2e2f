#include <polyfem/assembly/supernodal_solution.hpp>

#include <polyfem/core/parallel.hpp>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>

namespace polyfem {

namespace {

/// A factor of fewer entries is one thread's. A larger one is shared by parts of no more than this part of
/// its entries, and what is less than that part is left with the groups above.
constexpr double few_entries = 1e6, largest_part = 1. / 16, least_part = 1. / 256;

template <class Real>
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// The columns of a group in L or U^T: one over the diagonal on it, above it nothing.
template <class Real>
struct Group {
  Index first, n_columns, n_rows;  ///< rows with those of the block on the diagonal
  const int* row;                  ///< of each of them
  const int* target;               ///< where it adds to them
  DenseBlock<const Real> entries;

  Group(const FrontTree& tree, const Real* of_all, const std::vector<int>& targets, int s)
      : first(tree.first_column(s)),
        n_columns(tree.n_columns(s)),
        n_rows(std::ssize(tree.rows(s))),
        row(tree.rows(s).data()),
        target(targets.data() + tree.first_row(s)),
        entries(tree.columns(s, of_all)) {}
  const Real* column(Index c) const { return entries.column(static_cast<int>(c)); }
};

/// L y = x, y in place of x. Four columns at a time: w is read and written once for them.
template <class Real>
void solve_lower(const Group<Real>& group, Real* __restrict w, Real* __restrict x) {
  const Index n_columns = group.n_columns, n_rows = group.n_rows;
  std::copy_n(x + group.first, n_columns, w);
  std::fill(w + n_columns, w + n_rows, Real(0));
  Index c = 0;
  for (; c + 4 <= n_columns; c += 4) {
    const Real *const l0 = group.column(c), *const l1 = group.column(c + 1), *const l2 = group.column(c + 2),
                      *const l3 = group.column(c + 3);
    const Real y0 = w[c] * l0[c], y1 = (w[c + 1] - l0[c + 1] * y0) * l1[c + 1],
               y2 = (w[c + 2] - l0[c + 2] * y0 - l1[c + 2] * y1) * l2[c + 2],
               y3 = (w[c + 3] - l0[c + 3] * y0 - l1[c + 3] * y1 - l2[c + 3] * y2) * l3[c + 3];
    w[c] = y0;
    w[c + 1] = y1;
    w[c + 2] = y2;
    w[c + 3] = y3;
#pragma omp simd
    for (Index r = c + 4; r < n_rows; ++r) w[r] -= y0 * l0[r] + y1 * l1[r] + y2 * l2[r] + y3 * l3[r];
  }
  for (; c < n_columns; ++c) {
    const Real* const l0 = group.column(c);
    const Real y = w[c] *= l0[c];
#pragma omp simd
    for (Index r = c + 1; r < n_rows; ++r) w[r] -= y * l0[r];
  }
  std::copy_n(w, n_columns, x + group.first);
  for (Index r = n_columns; r < n_rows; ++r) x[group.target[r]] += w[r];
}

/// U y = x, y in place of x, with the columns of U^T.
template <class Real>
void solve_upper(const Group<Real>& group, Real* __restrict w, Real* __restrict x) {
  const Index n_columns = group.n_columns, n_rows = group.n_rows;
  for (Index r = n_columns; r < n_rows; ++r) w[r] = x[group.row[r]];
  Real* const own = x + group.first;
  Index c = n_columns;
  while (c % 4 != 0) {
    --c;
    const Real* const l0 = group.column(c);
    Real below = 0;
#pragma omp simd reduction(+ : below)
    for (Index r = c + 1; r < n_rows; ++r) below += l0[r] * w[r];
    w[c] = (own[c] - below) * l0[c];
  }
  while (c > 0) {
    c -= 4;
    const Real *const l0 = group.column(c), *const l1 = group.column(c + 1), *const l2 = group.column(c + 2),
                      *const l3 = group.column(c + 3);
    Real d0 = 0, d1 = 0, d2 = 0, d3 = 0;
#pragma omp simd reduction(+ : d0, d1, d2, d3)
    for (Index r = c + 4; r < n_rows; ++r) {
      d0 += l0[r] * w[r];
      d1 += l1[r] * w[r];
      d2 += l2[r] * w[r];
      d3 += l3[r] * w[r];
    }
    w[c + 3] = (own[c + 3] - d3) * l3[c + 3];
    w[c + 2] = (own[c + 2] - d2 - l2[c + 3] * w[c + 3]) * l2[c + 2];
    w[c + 1] = (own[c + 1] - d1 - l1[c + 3] * w[c + 3] - l1[c + 2] * w[c + 2]) * l1[c + 1];
    w[c] = (own[c] - d0 - l0[c + 3] * w[c + 3] - l0[c + 2] * w[c + 2] - l0[c + 1] * w[c + 1]) * l0[c];
  }
  std::copy_n(w, n_columns, own);
}

/// Of groups `first` .. `end` - 1.
Index most_rows(const FrontTree& tree, int first, int end) {
  Index most = 0;
  for (int s = first; s < end; ++s) most = std::max<Index>(most, std::ssize(tree.rows(s)));
  return most;
}

/// Of the fronts of groups `first` .. `end` - 1, one after another.
std::span<const int> rows_of(const FrontTree& tree, int first, int end) {
  return {tree.rows(first).data(), static_cast<std::size_t>(tree.first_row(end) - tree.first_row(first))};
}

}  // namespace

void SupernodalSolution::analyze(const FrontTree& tree) {
  const int n_groups = tree.n_groups();
  parts_.clear();
  above_.clear();
  row_of_sum_.clear();
  const std::span<const int> rows = rows_of(tree, 0, n_groups);
  target_.assign(rows.begin(), rows.end());

  // Entries of each group with all below it, and where these begin: groups are in postorder.
  std::vector<double> below(n_groups, 0);
  std::vector<int> first(n_groups);
  std::iota(first.begin(), first.end(), 0);
  for (int s = 0; s < n_groups; ++s) {
    below[s] += static_cast<double>(tree.n_columns(s)) * static_cast<double>(tree.rows(s).size());
    const int parent = tree.above(s);
    if (parent < 0) continue;
    below[parent] += below[s];
    first[parent] = std::min(first[parent], first[s]);
  }

  const auto n_entries = static_cast<double>(tree.n_entries());
  const double most = n_entries < few_entries ? 0 : largest_part * n_entries;
  int begin = 0, end = 0;  // of the part that grows
  double entries = 0;
  const auto close = [&] {
    if (entries > least_part * n_entries)
      add_part(tree, begin, end);
    else
      for (int s = begin; s < end; ++s) above_.push_back(s);
    begin = end;
    entries = 0;
  };
  for (int s = 0; s < n_groups; ++s) {
    if (below[s] > most) {
      close();
      above_.push_back(s);
    } else if (tree.above(s) < 0 || below[tree.above(s)] > most) {
      if (end != first[s] || entries + below[s] > most) close();
      if (entries == 0) begin = first[s];
      entries += below[s];
      end = s + 1;
    }
  }
  close();

  // Where groups work follows the sums, those above the parts first.
  scratch_ = tree.n_rows() + std::ssize(row_of_sum_);
  n_work_ = scratch_ + most_rows(tree, 0, n_groups);
  for (Part& part : parts_) {
    part.scratch = n_work_;
    n_work_ += most_rows(tree, part.first, part.end);
  }
}

void SupernodalSolution::add_part(const FrontTree& tree, int first, int end) {
  // Sums follow the unknowns in the work vector.
  const Index first_sum = tree.n_rows() + std::ssize(row_of_sum_);
  const int end_column = tree.first_column(end);
  const std::span<const int> rows = rows_of(tree, first, end);
  std::vector<int> sum_of_row;
  std::ranges::copy_if(rows, std::back_inserter(sum_of_row), [&](int row) { return row >= end_column; });
  std::ranges::sort(sum_of_row);
  sum_of_row.erase(std::unique(sum_of_row.begin(), sum_of_row.end()), sum_of_row.end());
  int* target = target_.data() + tree.first_row(first);
  for (const int row : rows) {
    if (row >= end_column)
      *target =
          static_cast<int>(first_sum + (std::ranges::lower_bound(sum_of_row, row) - sum_of_row.begin()));
    ++target;
  }
  parts_.push_back({first, end, first_sum, std::ssize(sum_of_row), 0});
  row_of_sum_.insert(row_of_sum_.end(), sum_of_row.begin(), sum_of_row.end());
}

template <class Real>
void SupernodalSolution::solve(const FrontTree& tree, const Real* lower, const Real* upper, const VectorXd& b,
                               Vector<Real>& work, VectorXd& x) const {
  const int n = tree.n_rows();
  const auto of_L = [&](int s) { return Group<Real>(tree, lower, target_, s); };
  const auto of_U = [&](int s) { return Group<Real>(tree, upper, target_, s); };
  const auto for_parts = [&](const auto& visit) {
    for_ranges(static_cast<Index>(parts_.size()), 1,
               [&](Index k, Index) { visit(parts_[static_cast<std::size_t>(k)]); });
  };
  work.resize(n_work_);
  Real *const y = work.data(), *const scratch = y + scratch_;  // unknowns, then sums
  for (int k = 0; k < n; ++k) y[k] = static_cast<Real>(b[tree.original_row(k)]);
  for_parts([&](const Part& part) {
    std::fill_n(y + part.first_sum, part.n_sums, Real(0));
    for (int s = part.first; s < part.end; ++s) solve_lower(of_L(s), y + part.scratch, y);
  });
  for (std::size_t k = 0; k < row_of_sum_.size(); ++k) y[row_of_sum_[k]] += y[n + static_cast<Index>(k)];
  for (const int s : above_) solve_lower(of_L(s), scratch, y);
  for (auto s = above_.rbegin(); s != above_.rend(); ++s) solve_upper(of_U(*s), scratch, y);
  for_parts([&](const Part& part) {
    for (int s = part.end; s-- > part.first;) solve_upper(of_U(s), y + part.scratch, y);
  });
  x.resize(n);
  for (int k = 0; k < n; ++k) x[tree.original_row(k)] = y[k];
}

void SupernodalSolution::solve(const FrontTree& tree, const LargeVector<double>& lower,
                               const LargeVector<double>& upper, const VectorXd& b, VectorXd& x) {
  solve(tree, lower.data(), upper.data(), b, work_, x);
}

void SupernodalSolution::solve(const FrontTree& tree, const LargeVector<float>& lower, const VectorXd& b,
                               VectorXd& x) {
  const double largest = b.lpNorm<Eigen::Infinity>(), scale = largest > 0 ? largest : 1;
  solve(tree, lower.data(), lower.data(), b / scale, rough_work_, x);
  x *= scale;
}

double SupernodalSolution::memory() const {
  return static_cast<double>(sizeof(int) * (target_.capacity() + row_of_sum_.capacity() + above_.capacity()) +
                             sizeof(Part) * parts_.capacity() +
                             sizeof(double) * static_cast<std::size_t>(work_.size()) +
                             sizeof(float) * static_cast<std::size_t>(rough_work_.size()));
}

}  // namespace polyfem
