#include <polyfem/assembly/supernodal_solution.hpp>

#include <polyfem/core/parallel.hpp>

#include <cholmod.h>

#include <algorithm>
#include <numeric>

namespace polyfem {

namespace {

/// A factor of fewer entries is one thread's. A larger one is shared by parts of no more than this part of
/// its entries, and what is less than that part is left with the groups above.
constexpr double few_entries = 1e6, largest_part = 1. / 16, least_part = 1. / 256;

template <class Real>
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Columns that have the same rows below the block on their diagonal.
template <class Real>
struct Group {
  Index first, n_columns, n_rows;  ///< rows with those of the block
  const int* row;                  ///< of each of them
  const int* target;               ///< where it adds to them
  const Real* entries;  ///< n_rows x n_columns, by columns, with one over the diagonal; above it nothing

  Group(const cholmod_factor_struct& L, const Real* of_all, const int* targets, std::size_t s) {
    const int *super = static_cast<const int*>(L.super), *first_row = static_cast<const int*>(L.pi);
    first = super[s];
    n_columns = super[s + 1] - super[s];
    n_rows = first_row[s + 1] - first_row[s];
    row = static_cast<const int*>(L.s) + first_row[s];
    target = targets + first_row[s];
    entries = of_all + static_cast<const int*>(L.px)[s];
  }
  const Real* column(Index c) const { return entries + c * n_rows; }
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
Index most_rows(const cholmod_factor_struct& L, std::size_t first, std::size_t end) {
  const int* const first_row = static_cast<const int*>(L.pi);
  int most = 0;
  for (std::size_t s = first; s < end; ++s) most = std::max(most, first_row[s + 1] - first_row[s]);
  return most;
}

}  // namespace

void SupernodalSolution::analyze(const cholmod_factor_struct& L) {
  const auto n_groups = L.nsuper;
  const int *super = static_cast<const int*>(L.super), *first_row = static_cast<const int*>(L.pi),
            *row = static_cast<const int*>(L.s);
  parts_.clear();
  above_.clear();
  row_of_sum_.clear();
  target_.assign(row, row + L.ssize);

  // Entries of each group with all below it, and where these begin: groups are in postorder.
  std::vector<int> group_of(L.n);
  for (std::size_t s = 0; s < n_groups; ++s)
    std::fill(group_of.begin() + super[s], group_of.begin() + super[s + 1], static_cast<int>(s));
  std::vector<double> below(n_groups, 0);
  std::vector<std::size_t> first(n_groups), parent(n_groups, n_groups);
  std::iota(first.begin(), first.end(), std::size_t(0));
  for (std::size_t s = 0; s < n_groups; ++s) {
    const int n_columns = super[s + 1] - super[s], n_rows = first_row[s + 1] - first_row[s];
    below[s] += static_cast<double>(n_columns) * n_rows;
    if (n_rows == n_columns) continue;
    parent[s] = static_cast<std::size_t>(group_of[static_cast<std::size_t>(row[first_row[s] + n_columns])]);
    below[parent[s]] += below[s];
    first[parent[s]] = std::min(first[parent[s]], first[s]);
  }

  const auto n_entries = static_cast<double>(L.xsize);
  const double most = n_entries < few_entries ? 0 : largest_part * n_entries;
  std::size_t begin = 0, end = 0;  // of the part that grows
  double entries = 0;
  const auto close = [&] {
    if (entries > least_part * n_entries)
      add_part(L, begin, end);
    else
      for (std::size_t s = begin; s < end; ++s) above_.push_back(s);
    begin = end;
    entries = 0;
  };
  for (std::size_t s = 0; s < n_groups; ++s) {
    if (below[s] > most) {
      close();
      above_.push_back(s);
    } else if (parent[s] == n_groups || below[parent[s]] > most) {
      if (end != first[s] || entries + below[s] > most) close();
      if (entries == 0) begin = first[s];
      entries += below[s];
      end = s + 1;
    }
  }
  close();

  // Where groups work follows the sums, those above the parts first.
  scratch_ = static_cast<Index>(L.n + row_of_sum_.size());
  n_work_ = scratch_ + most_rows(L, 0, n_groups);
  for (Part& part : parts_) {
    part.scratch = n_work_;
    n_work_ += most_rows(L, part.first, part.end);
  }
}

void SupernodalSolution::add_part(const cholmod_factor_struct& L, std::size_t first, std::size_t end) {
  const int *super = static_cast<const int*>(L.super), *first_row = static_cast<const int*>(L.pi),
            *row = static_cast<const int*>(L.s);
  // Sums follow the unknowns in the work vector.
  const std::size_t first_sum = L.n + row_of_sum_.size();
  std::vector<int> sum_of_row;
  for (int k = first_row[first]; k < first_row[end]; ++k)
    if (row[k] >= super[end]) sum_of_row.push_back(row[k]);
  std::sort(sum_of_row.begin(), sum_of_row.end());
  sum_of_row.erase(std::unique(sum_of_row.begin(), sum_of_row.end()), sum_of_row.end());
  for (int k = first_row[first]; k < first_row[end]; ++k)
    if (row[k] >= super[end])
      target_[static_cast<std::size_t>(k)] =
          static_cast<int>(first_sum) +
          static_cast<int>(std::lower_bound(sum_of_row.begin(), sum_of_row.end(), row[k]) -
                           sum_of_row.begin());
  parts_.push_back({first, end, static_cast<Index>(first_sum), static_cast<Index>(sum_of_row.size()), 0});
  row_of_sum_.insert(row_of_sum_.end(), sum_of_row.begin(), sum_of_row.end());
}

template <class Real>
void SupernodalSolution::solve(const cholmod_factor_struct& L, const Real* lower, const Real* upper,
                               const VectorXd& b, Vector<Real>& work, VectorXd& x) const {
  const int* const order = static_cast<const int*>(L.Perm);
  const Index n = b.size();
  const auto of_L = [&](std::size_t s) { return Group<Real>(L, lower, target_.data(), s); };
  const auto of_U = [&](std::size_t s) { return Group<Real>(L, upper, target_.data(), s); };
  const auto for_parts = [&](const auto& visit) {
    for_ranges(static_cast<Index>(parts_.size()), 1,
               [&](Index k, Index) { visit(parts_[static_cast<std::size_t>(k)]); });
  };
  work.resize(n_work_);
  Real *const y = work.data(), *const scratch = y + scratch_;  // unknowns, then sums
  for (Index k = 0; k < n; ++k) y[k] = static_cast<Real>(b[order[k]]);
  for_parts([&](const Part& part) {
    std::fill_n(y + part.first_sum, part.n_sums, Real(0));
    for (std::size_t s = part.first; s < part.end; ++s) solve_lower(of_L(s), y + part.scratch, y);
  });
  for (std::size_t k = 0; k < row_of_sum_.size(); ++k) y[row_of_sum_[k]] += y[n + static_cast<Index>(k)];
  for (const std::size_t s : above_) solve_lower(of_L(s), scratch, y);
  for (auto s = above_.rbegin(); s != above_.rend(); ++s) solve_upper(of_U(*s), scratch, y);
  for_parts([&](const Part& part) {
    for (std::size_t s = part.end; s-- > part.first;) solve_upper(of_U(s), y + part.scratch, y);
  });
  x.resize(n);
  for (Index k = 0; k < n; ++k) x[order[k]] = y[k];
}

void SupernodalSolution::solve(const cholmod_factor_struct& L, const LargeVector<double>& lower,
                               const LargeVector<double>& upper, const VectorXd& b, VectorXd& x) {
  solve(L, lower.data(), upper.data(), b, work_, x);
}

void SupernodalSolution::solve(const cholmod_factor_struct& L, const LargeVector<float>& lower,
                               const LargeVector<float>& upper, const VectorXd& b, VectorXd& x) {
  const double largest = b.lpNorm<Eigen::Infinity>(), scale = largest > 0 ? largest : 1;
  solve(L, lower.data(), upper.data(), b / scale, rough_work_, x);
  x *= scale;
}

double SupernodalSolution::memory() const {
  return static_cast<double>(sizeof(int) * (target_.capacity() + row_of_sum_.capacity()) +
                             sizeof(std::size_t) * above_.capacity() + sizeof(Part) * parts_.capacity() +
                             sizeof(double) * static_cast<std::size_t>(work_.size()) +
                             sizeof(float) * static_cast<std::size_t>(rough_work_.size()));
}

}  // namespace polyfem
