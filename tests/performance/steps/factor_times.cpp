#include "factor_times.hpp"

#include "clock.hpp"

#include <polyfem/core/error.hpp>

#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace step_performance {

namespace {

using polyfem::SparseMatrix;

struct Common : cholmod_common {
  Common() { cholmod_start(this); }
  ~Common() { cholmod_finish(this); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;

  void check() const {
    if (status < CHOLMOD_OK) throw polyfem::Error("CHOLMOD failed, status " + std::to_string(status));
  }
};

cholmod_sparse view_of(const SparseMatrix& lower) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(lower.rows());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  view.p = const_cast<int*>(lower.outerIndexPtr());
  view.i = const_cast<int*>(lower.innerIndexPtr());
  view.x = const_cast<double*>(lower.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

/// Rows 2 k and 2 k + 1 as one.
SparseMatrix graph_of_pairs(const SparseMatrix& lower) {
  const int n = static_cast<int>(lower.rows()) / 2;
  std::vector<int> first{0}, rows, last_seen(static_cast<std::size_t>(n), -1);
  for (int pair = 0; pair < n; ++pair) {
    for (int column = 2 * pair; column < 2 * pair + 2; ++column)
      for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry)
        if (const int row = static_cast<int>(entry.row()) / 2; std::exchange(last_seen[row], pair) != pair)
          rows.push_back(row);
    std::sort(rows.begin() + first.back(), rows.end());
    first.push_back(static_cast<int>(rows.size()));
  }
  std::vector<double> ones(rows.size(), 1);
  return Eigen::Map<const SparseMatrix>(n, n, static_cast<polyfem::Index>(rows.size()), first.data(),
                                        rows.data(), ones.data());
}

std::vector<int> order_of(const SparseMatrix& lower, Ordering ordering, Common& common) {
  const bool by_pairs = lower.rows() % 2 == 0;
  const SparseMatrix graph = by_pairs ? graph_of_pairs(lower) : lower;
  cholmod_sparse view = view_of(graph);
  std::vector<int> order(static_cast<std::size_t>(graph.rows()));
  if (ordering == Ordering::amd)
    cholmod_amd(&view, nullptr, 0, order.data(), &common);
  else
    cholmod_metis(&view, nullptr, 0, 1, order.data(), &common);
  common.check();
  if (!by_pairs) return order;
  std::vector<int> of_rows;
  for (const int pair : order) of_rows.insert(of_rows.end(), {2 * pair, 2 * pair + 1});
  return of_rows;
}

}  // namespace

FactorTimes cholmod_times(const SparseMatrix& lower, Ordering ordering, double most_mb) {
  FactorTimes times;
  if (lower.rows() == 0) return times;
  omp_set_num_threads(1);  // CHOLMOD's own would wait for each other
  Common common;
  common.print = 0;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  cholmod_sparse A = view_of(lower);
  cholmod_factor* L = nullptr;
  times.analysis = median_time(1, [&] {
    std::vector<int> order = order_of(lower, ordering, common);
    L = cholmod_analyze_p(&A, order.data(), nullptr, 0, &common);
  });
  common.check();
  const auto free_factor = [&](cholmod_factor* factor) { cholmod_free_factor(&factor, &common); };
  const std::unique_ptr<cholmod_factor, decltype(free_factor)> owner(L, free_factor);
  if (8e-6 * common.lnz > most_mb) return {};
  times.factorization = median_time(3, [&] { cholmod_factorize(&A, L, &common); });
  common.check();
  times.factor = 1e-6 * (L->is_super ? 8. * static_cast<double>(L->xsize) + 4. * static_cast<double>(L->ssize)
                                     : 12. * static_cast<double>(L->nzmax));
  cholmod_dense* b = cholmod_ones(L->n, 1, CHOLMOD_REAL, &common);
  times.solution = median_time(3, [&] {
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, L, b, &common);
    cholmod_free_dense(&x, &common);
  });
  cholmod_free_dense(&b, &common);
  common.check();
  return times;
}

FactorTimes own_times(const SparseMatrix& lower) {
  FactorTimes times;
  if (lower.rows() == 0) return times;
  polyfem::Cholesky cholesky;
  times.analysis = median_time(1, [&] { cholesky.analyze(lower); });
  bool is_definite = true;
  times.factorization = median_time(3, [&] { is_definite = cholesky.factorize(lower); });
  if (!is_definite) throw polyfem::Error("the matrix of the step is not positive definite");
  const polyfem::VectorXd b = polyfem::VectorXd::Ones(lower.rows());
  polyfem::VectorXd x;
  times.solution = median_time(3, [&] { cholesky.solve(b, x); });
  times.factor = 8e-6 * cholesky.n_factor_entries();
  return times;
}

}  // namespace step_performance
