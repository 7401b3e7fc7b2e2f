#include <polyfem/assembly/supernodal_solution.hpp>

#include <cholmod.h>

namespace polyfem {

namespace {

template <class Real>
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Columns that have the same rows below the block on their diagonal.
template <class Real>
struct Group {
  Index first, n_columns, n_rows;  ///< rows with those of the block
  const int* row;                  ///< of each of them
  const Real* entries;             ///< n_rows x n_columns, by columns; above the diagonal nothing

  Group(const cholmod_factor_struct& L, const Real* of_all, std::size_t s) {
    const int *super = static_cast<const int*>(L.super), *first_row = static_cast<const int*>(L.pi);
    first = super[s];
    n_columns = super[s + 1] - super[s];
    n_rows = first_row[s + 1] - first_row[s];
    row = static_cast<const int*>(L.s) + first_row[s];
    entries = of_all + static_cast<const int*>(L.px)[s];
  }
  const Real* column(Index c) const { return entries + c * n_rows; }
  /// The part of a column from a row on.
  Eigen::Map<const Vector<Real>> below(Index c, Index r) const { return {column(c) + r, n_rows - r}; }
};

/// L y = x, y in place of x.
template <class Real>
void solve_lower(const Group<Real>& group, Eigen::Ref<Vector<Real>> work, Eigen::Ref<Vector<Real>> x) {
  auto w = work.head(group.n_rows);
  w.head(group.n_columns) = x.segment(group.first, group.n_columns);
  w.tail(group.n_rows - group.n_columns).setZero();
  Index c = 0;
  for (; c + 4 <= group.n_columns; c += 4) {  // four at a time: w is read and written once for them
    Real y[4];
    for (Index k = 0; k < 4; ++k) {
      y[k] = w[c + k];
      for (Index l = 0; l < k; ++l) y[k] -= group.column(c + l)[c + k] * y[l];
      w[c + k] = y[k] /= group.column(c + k)[c + k];
    }
    const Index r = c + 4;
    w.tail(group.n_rows - r) -= y[0] * group.below(c, r) + y[1] * group.below(c + 1, r) +
                                y[2] * group.below(c + 2, r) + y[3] * group.below(c + 3, r);
  }
  for (; c < group.n_columns; ++c) {
    const Real y = w[c] /= group.column(c)[c];
    w.tail(group.n_rows - c - 1) -= y * group.below(c, c + 1);
  }
  x.segment(group.first, group.n_columns) = w.head(group.n_columns);
  for (Index r = group.n_columns; r < group.n_rows; ++r) x[group.row[r]] += w[r];
}

/// L^T y = x, y in place of x.
template <class Real>
void solve_upper(const Group<Real>& group, Eigen::Ref<Vector<Real>> work, Eigen::Ref<Vector<Real>> x) {
  auto w = work.head(group.n_rows);
  for (Index r = group.n_columns; r < group.n_rows; ++r) w[r] = x[group.row[r]];
  for (Index c = group.n_columns; c-- > 0;) {
    const Real below = group.below(c, c + 1).dot(w.tail(group.n_rows - c - 1));
    w[c] = (x[group.first + c] - below) / group.column(c)[c];
  }
  x.segment(group.first, group.n_columns) = w.head(group.n_columns);
}

template <class Real>
void solve(const cholmod_factor_struct& L, const Real* entries, const VectorXd& b, Vector<Real>& work,
           VectorXd& x) {
  const int* const order = static_cast<const int*>(L.Perm);
  const Index n = b.size();
  work.resize(2 * n);
  auto of_group = work.head(n), y = work.tail(n);  // no group has more rows
  for (Index k = 0; k < n; ++k) y[k] = static_cast<Real>(b[order[k]]);
  for (std::size_t s = 0; s < L.nsuper; ++s) solve_lower<Real>({L, entries, s}, of_group, y);
  for (std::size_t s = L.nsuper; s-- > 0;) solve_upper<Real>({L, entries, s}, of_group, y);
  x.resize(n);
  for (Index k = 0; k < n; ++k) x[order[k]] = y[k];
}

}  // namespace

void solve_supernodal(const cholmod_factor_struct& L, const VectorXd& b, VectorXd& work, VectorXd& x) {
  solve(L, static_cast<const double*>(L.x), b, work, x);
}

void solve_supernodal(const cholmod_factor_struct& L, const std::vector<float>& entries, const VectorXd& b,
                      Eigen::VectorXf& work, VectorXd& x) {
  const double largest = b.lpNorm<Eigen::Infinity>(), scale = largest > 0 ? largest : 1;
  solve(L, entries.data(), b / scale, work, x);
  x *= scale;
}

std::vector<float> single_precision_entries(const cholmod_factor_struct& L) {
  const double* const x = static_cast<const double*>(L.x);
  return {x, x + L.xsize};
}

}  // namespace polyfem
