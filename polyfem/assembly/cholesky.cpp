#include <polyfem/assembly/blas.hpp>
#include <polyfem/assembly/cholesky.hpp>
#include <polyfem/assembly/single_precision_factor.hpp>
#include <polyfem/assembly/supernodal_solution.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/core/out_of_memory.hpp>
#include <polyfem/core/stopwatch.hpp>

#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <cassert>
#include <optional>
#include <string>
#include <utility>

namespace polyfem {

/// What CHOLMOD allocates and frees.
struct Cholesky::Factor {
  cholmod_common common{};
  cholmod_factor* L = nullptr;
  cholmod_dense *solution = nullptr, *work_y = nullptr, *work_e = nullptr;  // kept from solve to solve
  SupernodalSolution solution_of_groups;
  SinglePrecisionFactor rough;  ///< made so, or of rounded entries without a scale
  bool has_rough = false;       ///< `rough` is of the present matrix

  Factor() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_AUTO;
    common.supernodal_switch = 55;  // operations an entry; below, dense kernels cost more than they bring
    common.final_ll = 1;  // L L^T also where it is not supernodal: L D L^T would accept an indefinite matrix
  }
  ~Factor() {
    cholmod_free_dense(&work_e, &common);
    cholmod_free_dense(&work_y, &common);
    cholmod_free_dense(&solution, &common);
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }
  /// Of another matrix. The memory of a rounded copy serves the next one.
  void outdate_rough() {
    if (rough.scale.size() > 0) rough = {};
    has_rough = false;
  }
  void forget_rough() {
    rough = {};
    has_rough = false;
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  void check(const char* action, Index n_rows) const {
    if (common.status >= CHOLMOD_OK) return;
    const std::string what =
        std::string("CHOLMOD could not ") + action + " a matrix of " + std::to_string(n_rows) + " rows";
    const std::string entries =
        common.lnz > 0 ? " with " + std::to_string(static_cast<long>(common.lnz)) + " entries" : "";
    if (common.status == CHOLMOD_OUT_OF_MEMORY)
      throw OutOfMemory(what + ": not enough memory for its factor" + entries);
    if (common.status == CHOLMOD_TOO_LARGE)
      throw OutOfMemory(what + ": its factor" + entries + " is too large for 32-bit indices");
    throw Error(what + " (status " + std::to_string(common.status) + ")");
  }
};

namespace {

/// Operations an entry of L, from which on single precision gains more than the refinement takes.
constexpr double much_work = 100;

/// CHOLMOD asks OpenMP for threads of its own, whose waiting costs more than they bring: while this lives
/// they are not given.
class NoThreads {
 public:
  NoThreads() { omp_set_max_active_levels(0); }
  ~NoThreads() { omp_set_max_active_levels(before_); }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;

 private:
  int before_ = omp_get_max_active_levels();
};

/// The same storage seen by CHOLMOD, which does not write to it.
cholmod_sparse view_of_lower(const SparseMatrix& lower) {
  assert(lower.isCompressed() && lower.rows() == lower.cols());
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(lower.rows());
  view.ncol = static_cast<std::size_t>(lower.cols());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  view.p = const_cast<int*>(lower.outerIndexPtr());
  view.i = const_cast<int*>(lower.innerIndexPtr());
  view.x = const_cast<double*>(lower.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

cholmod_dense view_of(const VectorXd& b) {
  cholmod_dense view{};
  view.nrow = view.nzmax = view.d = static_cast<std::size_t>(b.size());
  view.ncol = 1;
  view.x = const_cast<double*>(b.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

}  // namespace

Cholesky::Cholesky() : factor_(std::make_unique<Factor>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

void Cholesky::analyze(const SparseMatrix& lower) {
  ++work_.n_analyses;
  const Stopwatch watch(work_.analysis);
  cholmod_free_factor(&factor_->L, &factor_->common);
  factor_->forget_rough();
  if (lower.rows() == 0) return;
  cholmod_sparse A = view_of_lower(lower);
  factor_->L = cholmod_analyze(&A, &factor_->common);
  factor_->check("analyze", lower.rows());
  if (factor_->L->is_super) factor_->solution_of_groups.analyze(*factor_->L);
}

void Cholesky::dissect(const SparseMatrix& lower) {
  analyze(lower, CHOLMOD_METIS, nullptr);
}

void Cholesky::analyze(const SparseMatrix& lower, std::span<const int> order) {
  assert(static_cast<Index>(order.size()) == lower.rows());
  analyze(lower, CHOLMOD_GIVEN, order.data());
}

/// By one of CHOLMOD's orderings; the order if that is given.
void Cholesky::analyze(const SparseMatrix& lower, int ordering, const int* order) {
  ++work_.n_analyses;
  const Stopwatch watch(work_.analysis);
  cholmod_free_factor(&factor_->L, &factor_->common);
  factor_->forget_rough();
  if (lower.rows() == 0) return;
  cholmod_sparse A = view_of_lower(lower);
  const int n_methods = std::exchange(factor_->common.nmethods, 1);
  const int before = std::exchange(factor_->common.method[0].ordering, ordering);
  factor_->L = cholmod_analyze_p(&A, const_cast<int*>(order), nullptr, 0, &factor_->common);
  factor_->common.nmethods = n_methods;
  factor_->common.method[0].ordering = before;
  factor_->check("analyze", lower.rows());
  if (factor_->L->is_super) factor_->solution_of_groups.analyze(*factor_->L);
}

bool Cholesky::factorize(const SparseMatrix& lower) {
  ++work_.n_factorizations;
  const Stopwatch watch(work_.factorization);
  const NoThreads no_threads;
  if (lower.rows() == 0) return true;
  assert(factor_->L && static_cast<Index>(factor_->L->n) == lower.rows());
  factor_->outdate_rough();
  if (factor_->L->is_super) expect_room_for_blas(sizeof(double) * (factor_->L->xsize + factor_->L->maxcsize));
  cholmod_sparse A = view_of_lower(lower);
  cholmod_factorize(&A, factor_->L, &factor_->common);
  factor_->check("factorize", lower.rows());
  return factor_->L->minor == factor_->L->n;
}

bool Cholesky::factorize_roughly(const SparseMatrix& lower) {
  assert(factor_->L || lower.rows() == 0);
  if (lower.rows() == 0 || !factor_->L->is_super || factor_->common.fl < much_work * factor_->common.lnz)
    return false;
  const Stopwatch watch(work_.factorization);
  expect_room_for_blas(sizeof(float) * (factor_->L->xsize + factor_->L->maxcsize));
  factor_->forget_rough();
  try {
    if (std::optional<SinglePrecisionFactor> made = single_precision_factor(*factor_->L, lower)) {
      factor_->rough = std::move(*made);
      factor_->has_rough = true;
      ++work_.n_factorizations;
    }
  } catch (const std::bad_alloc&) {
    factor_->common.status = CHOLMOD_OUT_OF_MEMORY;
    factor_->check("factorize", lower.rows());
  }
  return factor_->has_rough;
}

void Cholesky::solve(const VectorXd& b, VectorXd& x) {
  ++work_.n_solves;
  const Stopwatch watch(work_.solution);
  x.resize(b.size());
  if (b.size() == 0) return;
  assert(factor_->L && static_cast<Index>(factor_->L->n) == b.size());
  if (factor_->L->is_super) {
    factor_->solution_of_groups.solve(*factor_->L, b, x);
    return;
  }
  const NoThreads no_threads;
  cholmod_dense rhs = view_of(b);
  cholmod_solve2(CHOLMOD_A, factor_->L, &rhs, nullptr, &factor_->solution, nullptr, &factor_->work_y,
                 &factor_->work_e, &factor_->common);
  factor_->check("solve with", b.size());
  std::copy_n(static_cast<const double*>(factor_->solution->x), b.size(), x.data());
}

void Cholesky::solve_roughly(const VectorXd& b, VectorXd& x) {
  if (b.size() == 0 || !factor_->L->is_super) {
    solve(b, x);
    return;
  }
  ++work_.n_solves;
  const Stopwatch watch(work_.solution);
  SinglePrecisionFactor& rough = factor_->rough;
  if (!factor_->has_rough) {
    rough.scale.resize(0);
    round_entries(*factor_->L, rough.entries);
    factor_->has_rough = true;
  }
  if (rough.scale.size() == 0) {
    factor_->solution_of_groups.solve(*factor_->L, rough.entries, b, x);
    return;
  }
  factor_->solution_of_groups.solve(*factor_->L, rough.entries, b.cwiseProduct(rough.scale), x);
  x.array() *= rough.scale.array();
}

int Cholesky::failed_row() const {
  const cholmod_factor* L = factor_->L;
  return L && L->minor < L->n ? static_cast<const int*>(L->Perm)[L->minor] : -1;
}

double Cholesky::memory() const {
  return static_cast<double>(factor_->common.memory_inuse) + factor_->rough.memory() +
         factor_->solution_of_groups.memory();
}

double Cholesky::n_factor_entries() const {
  return factor_->L ? factor_->common.lnz : 0;
}

std::vector<int> minimum_degree_order(std::span<const int> first, std::span<const int> row,
                                      std::span<const int> group) {
  std::vector<int> order(first.size() - 1);
  if (order.empty()) return order;
  cholmod_sparse pattern{};
  pattern.nrow = pattern.ncol = order.size();
  pattern.nzmax = row.size();
  pattern.p = const_cast<int*>(first.data());
  pattern.i = const_cast<int*>(row.data());
  pattern.stype = -1;
  pattern.itype = CHOLMOD_INT;
  pattern.xtype = CHOLMOD_PATTERN;
  pattern.dtype = CHOLMOD_DOUBLE;
  pattern.sorted = pattern.packed = 1;
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  const bool done = (group.empty() ? cholmod_amd(&pattern, nullptr, 0, order.data(), &common)
                                   : cholmod_camd(&pattern, nullptr, 0, const_cast<int*>(group.data()),
                                                  order.data(), &common)) != 0;
  cholmod_finish(&common);
  if (!done) throw Error("CHOLMOD could not order a matrix of " + std::to_string(order.size()) + " rows");
  return order;
}

}  // namespace polyfem
