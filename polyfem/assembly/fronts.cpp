#include <polyfem/assembly/fronts.hpp>
#include <polyfem/core/types.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

extern "C" {
void ssyrk_(const char*, const char*, const int*, const int*, const float*, const float*, const int*,
            const float*, float*, const int*);
void dsyrk_(const char*, const char*, const int*, const int*, const double*, const double*, const int*,
            const double*, double*, const int*);
void sgemm_(const char*, const char*, const int*, const int*, const int*, const float*, const float*,
            const int*, const float*, const int*, const float*, float*, const int*);
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
            const int*, const double*, const int*, const double*, double*, const int*);
}

namespace polyfem {

namespace {

/// Fewer columns, or less than twice as many rows, are quicker by plain loops than by BLAS.
constexpr int few_for_blas = 8;

constexpr auto syrk(float) {
  return ssyrk_;
}
constexpr auto syrk(double) {
  return dsyrk_;
}
constexpr auto gemm(float) {
  return sgemm_;
}
constexpr auto gemm(double) {
  return dgemm_;
}

/// The part of a column from a row on.
template <class Real>
Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, 1>> part(const DenseBlock<Real>& block, int column, int row) {
  return {block.column(column) + row, block.n_rows - row};
}

/// C -= A B^T, from the diagonal of C down where `is_lower`: what is above it counts for nothing then. By plain
/// loops for fewer columns of A, or less than twice as many rows of C.
template <class Real>
void subtract_product(const DenseBlock<Real>& A, const DenseBlock<Real>& B, const DenseBlock<Real>& C,
                      bool is_lower, int few_columns) {
  if (A.n_columns >= few_columns && C.n_rows / 2 >= few_columns) {
    const Real minus = -1, one = 1;
    const int n = C.n_columns, done = is_lower && A.first == B.first ? n : 0, rest = C.n_rows - done;
    if (done > 0)
      syrk(Real())("L", "N", &n, &A.n_columns, &minus, A.first, &A.stride, &one, C.first, &C.stride);
    if (rest > 0)
      gemm(Real())("N", "T", &rest, &n, &A.n_columns, &minus, A.first + done, &A.stride, B.first, &B.stride,
                   &one, C.first + done, &C.stride);
    return;
  }
  for (int c = 0; c < C.n_columns; ++c) {
    const int r = is_lower ? c : 0;
    auto target = part(C, c, r);
    int k = 0;
    for (; k + 4 <= A.n_columns; k += 4)  // four at a time: the target is read and written once for them
      target -= B.at(c, k) * part(A, k, r) + B.at(c, k + 1) * part(A, k + 1, r) +
                B.at(c, k + 2) * part(A, k + 2, r) + B.at(c, k + 3) * part(A, k + 3, r);
    for (; k < A.n_columns; ++k) target -= B.at(c, k) * part(A, k, r);
  }
}

/// Columns of L and U^T in place of those of a front. Returns how many have a pivot that serves, up to the
/// first that has none.
template <class Real>
int eliminate_columns(const DenseBlock<Real>& L, const DenseBlock<Real>& Ut, Real least, int few_columns) {
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
  if (const int done = eliminate_columns(first, first_t, least, few_columns); done < left) return done;
  const DenseBlock<Real> A = first.below(left, 0), B = first_t.below(left, 0);
  subtract_product(A, B, second, true, few_columns);
  if (!is_symmetric) subtract_product(B, A, second_t, true, few_columns);
  return left + eliminate_columns(second, second_t, least, few_columns);
}

}  // namespace

template <class Real>
Fronts<Real>::Fronts(const FrontTree& tree, Real* L, Real* Ut, LargeVector<Real>& waiting, bool by_blas)
    : tree_(tree),
      L_(L),
      Ut_(Ut),
      waiting_(waiting),
      few_columns_(by_blas ? few_for_blas : std::numeric_limits<int>::max()) {
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
  const int done = eliminate_columns(L, Ut, least, few_columns_);
  if (done < n || n_below == 0) return done;
  subtract_product(L.below(n, 0), Ut.below(n, 0), below, is_symmetric(), few_columns_);
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
