#include <polyfem/assembly/dense_product.hpp>
#include <polyfem/assembly/fronts.hpp>
#include <polyfem/core/types.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace polyfem {

namespace {

/// The part of a column from a row on.
template <class Real>
Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, 1>> part(const DenseBlock<Real>& block, int column, int row) {
  return {block.column(column) + row, block.n_rows - row};
}

/// Columns of L and U^T in place of those of a front. Returns how many have a pivot that serves, up to the
/// first that has none.
template <class Real>
int eliminate_columns(const DenseBlock<Real>& L, const DenseBlock<Real>& Ut, Real least, bool by_blas) {
  const bool is_symmetric = L.first == Ut.first;
  const int n = L.n_columns;
  if (n == 1) {
    const Real pivot = *L.first;
    const Real inverse = 1 / (is_symmetric ? std::sqrt(pivot) : pivot);
    if ((is_symmetric && !(pivot > least)) || !std::isfinite(pivot) || !std::isfinite(inverse)) return 0;
    part(Ut, 0, 1) *= inverse;
    *Ut.first = 1;
    *L.first = inverse;
    return 1;
  }
  const int left = n <= 4 ? n / 2 : (n / 2 + 3) / 4 * 4;
  const DenseBlock<Real> first = L.columns(left), first_t = Ut.columns(left), second = L.below(left, left),
                         second_t = Ut.below(left, left);
  if (const int done = eliminate_columns(first, first_t, least, by_blas); done < left) return done;
  const DenseBlock<Real> A = first.below(left, 0), B = first_t.below(left, 0);
  subtract_product(A, B, second, true, by_blas);
  if (!is_symmetric) subtract_product(B, A, second_t, true, by_blas);
  return left + eliminate_columns(second, second_t, least, by_blas);
}

}  // namespace

template <class Real>
Fronts<Real>::Fronts(const FrontTree& tree, Real* L, Real* Ut, LargeVector<Real>& waiting, bool by_blas)
    : tree_(tree), L_(L), Ut_(Ut), waiting_(waiting), by_blas_(by_blas) {
  assert(std::ssize(waiting) >= tree.most_waiting());
}

template <class Real>
int Fronts<Real>::eliminate(int s, Real least) {
  const DenseBlock<Real> L = tree_.columns(s, L_), Ut = tree_.columns(s, Ut_);
  const int n = L.n_columns, n_below = tree_.n_below(s);
  Real* const top = waiting_.data() + top_;
  std::fill_n(top, square(s), Real(0));
  const DenseBlock<Real> below{top, n_below, n_below, n_below};
  for (int k = 0; k < tree_.n_children(s); ++k) {
    const int child = groups_.back();
    groups_.pop_back();
    top_ -= square(child);
    take_from(child, waiting_.data() + top_, L, Ut, below);
  }
  const int done = eliminate_columns(L, Ut, least, by_blas_);
  if (done < n || n_below == 0) return done;
  subtract_product(L.below(n, 0), Ut.below(n, 0), below, is_symmetric(), by_blas_);
  std::copy_n(top, square(s), waiting_.data() + top_);
  groups_.push_back(s);
  top_ += square(s);
  return done;
}

/// Adds what a child has passed up to the columns of the group and to what the group passes up itself.
template <class Real>
void Fronts<Real>::take_from(int child, const Real* from, const DenseBlock<Real>& L,
                             const DenseBlock<Real>& Ut, const DenseBlock<Real>& below) const {
  const std::span<const int> places = tree_.places(child);
  const int n = static_cast<int>(places.size()), n_own = L.n_columns;
  const int n_in_own = static_cast<int>(std::ranges::lower_bound(places, n_own) - places.begin());
  for (int j = 0; j < n; ++j, from += n) {
    const int c = places[j];
    Real* const to = j < n_in_own ? L.column(c) : below.column(c - n_own) - n_own;
    for (int i = j; i < n; ++i) to[places[i]] += from[i];
    if (is_symmetric()) continue;
    for (int i = 0; i < std::min(j, n_in_own); ++i) Ut.column(places[i])[c] += from[i];
    for (int i = n_in_own; i < j; ++i) to[places[i]] += from[i];
  }
}

template class Fronts<float>;
template class Fronts<double>;

}  // namespace polyfem
