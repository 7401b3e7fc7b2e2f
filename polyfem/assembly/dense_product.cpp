#include <polyfem/assembly/dense_product.hpp>

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

/// Fewer columns, or less than twice as many rows, are as quick by loops as by BLAS.
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

/// t_u -= sum of b_ku a_k over columns t and a, numbers b.
template <int n_targets, int n_terms, class Real>
[[gnu::always_inline]] inline void subtract(int n, const DenseBlock<Real>& a, const DenseBlock<Real>& b,
                                            const DenseBlock<Real>& t) {
  Real factor[n_targets][n_terms];
  for (int u = 0; u < n_targets; ++u)
    for (int k = 0; k < n_terms; ++k) factor[u][k] = b.at(u, k);
#pragma omp simd
  for (int i = 0; i < n; ++i)
#pragma GCC unroll 4
    for (int u = 0; u < n_targets; ++u) {
      Real sum = factor[u][0] * a.first[i];
#pragma GCC unroll 4
      for (int k = 1; k < n_terms; ++k) sum += factor[u][k] * a.column(k)[i];
      t.column(u)[i] -= sum;
    }
}

/// C -= A B^T by loops: two columns of C and four of A at a time, so that each is read and written seldom.
template <int n_targets, class Real>
[[gnu::always_inline]] inline void subtract_columns(const DenseBlock<Real>& A, const DenseBlock<Real>& B,
                                                    const DenseBlock<Real>& C) {
  int k = 0;
  for (; k + 4 <= A.n_columns; k += 4) subtract<n_targets, 4>(C.n_rows, A.below(0, k), B.below(0, k), C);
  for (; k < A.n_columns; ++k) subtract<n_targets, 1>(C.n_rows, A.below(0, k), B.below(0, k), C);
}

template <class Real>
[[gnu::always_inline]] inline void subtract_by_loops(const DenseBlock<Real>& A, const DenseBlock<Real>& B,
                                                     const DenseBlock<Real>& C, bool is_lower) {
  for (int c = 0; c < C.n_columns;) {
    const int r = is_lower ? c : 0;
    const DenseBlock<Real> a = A.below(r, 0), b = B.below(c, 0), to = C.below(r, c);
    if (c + 2 <= C.n_columns) {
      subtract_columns<2>(a, b, to);
      c += 2;
    } else {
      subtract_columns<1>(a, b, to);
      c += 1;
    }
  }
}

#ifdef __x86_64__
const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;

/// Four numbers at a time for two; without fused operations, so that each is rounded as by loops.
template <class Real>
[[gnu::target("avx2")]] void subtract_by_avx2(const DenseBlock<Real>& A, const DenseBlock<Real>& B,
                                              const DenseBlock<Real>& C, bool is_lower) {
  subtract_by_loops(A, B, C, is_lower);
}
#else
constexpr bool has_avx2 = false;

template <class Real>
void subtract_by_avx2(const DenseBlock<Real>&, const DenseBlock<Real>&, const DenseBlock<Real>&, bool) {}
#endif

}  // namespace

template <class Real>
void subtract_product(const DenseBlock<Real>& A, const DenseBlock<Real>& B, const DenseBlock<Real>& C,
                      bool is_lower, bool by_blas) {
  if (by_blas && A.n_columns >= few_for_blas && C.n_rows / 2 >= few_for_blas) {
    const Real minus = -1, one = 1;
    const int n = C.n_columns, done = is_lower && A.first == B.first ? n : 0, rest = C.n_rows - done;
    if (done > 0)
      syrk(Real())("L", "N", &n, &A.n_columns, &minus, A.first, &A.stride, &one, C.first, &C.stride);
    if (rest > 0)
      gemm(Real())("N", "T", &rest, &n, &A.n_columns, &minus, A.first + done, &A.stride, B.first, &B.stride,
                   &one, C.first + done, &C.stride);
  } else if (has_avx2) {
    subtract_by_avx2(A, B, C, is_lower);
  } else {
    subtract_by_loops(A, B, C, is_lower);
  }
}

template void subtract_product(const DenseBlock<float>&, const DenseBlock<float>&, const DenseBlock<float>&,
                               bool, bool);
template void subtract_product(const DenseBlock<double>&, const DenseBlock<double>&,
                               const DenseBlock<double>&, bool, bool);

}  // namespace polyfem
