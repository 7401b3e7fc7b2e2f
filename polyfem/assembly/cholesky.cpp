#include <polyfem/assembly/blas.hpp>
#include <polyfem/assembly/cholesky.hpp>
#include <polyfem/assembly/fronts.hpp>
#include <polyfem/assembly/single_precision_factor.hpp>
#include <polyfem/assembly/supernodal_solution.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/core/out_of_memory.hpp>
#include <polyfem/core/stopwatch.hpp>

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <optional>
#include <string>
#include <utility>

namespace polyfem {

/// The order and the pattern of L, which CHOLMOD finds, and its entries.
struct Cholesky::Factor {
  cholmod_common common{};
  cholmod_factor* L = nullptr;
  bool is_analyzed = false;
  std::optional<FrontTree> tree;
  /// Of each entry of K among those of L; ~place: among those of U^T, it is eliminated as one above.
  std::vector<int> place;
  LargeVector<double> entries, waiting;
  LargeVector<double> upper;   ///< entries of U^T, of the last unsymmetric K
  bool is_symmetric = true;    ///< the factor is L L^T
  std::ptrdiff_t failed = -1;  ///< the column whose pivot did not serve
  SupernodalSolution solution_of_groups;
  SinglePrecisionFactor rough;  ///< made so, or of rounded entries without a scale
  LargeVector<float> rough_upper;
  bool has_rough = false;  ///< they are of the present matrix

  Factor() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
  }
  ~Factor() {
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
    rough_upper = {};
    has_rough = false;
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  /// \param[in] ordering  one of CHOLMOD's; none: as CHOLMOD chooses
  /// \param[in] order     for CHOLMOD_GIVEN
  void analyze(const SparseMatrix& lower, std::optional<int> ordering, const int* order = nullptr);
  void find_places(const SparseMatrix& lower);
  const LargeVector<double>& above() const { return is_symmetric ? entries : upper; }

  void check(const char* action, Index n_rows) const {
    if (common.status >= CHOLMOD_OK) return;
    const std::string what =
        std::string("CHOLMOD could not ") + action + " a matrix of " + std::to_string(n_rows) + " rows";
    const std::string size =
        common.lnz > 0 ? " with " + std::to_string(static_cast<long>(common.lnz)) + " entries" : "";
    if (common.status == CHOLMOD_OUT_OF_MEMORY)
      throw OutOfMemory(what + ": not enough memory for its factor" + size);
    if (common.status == CHOLMOD_TOO_LARGE)
      throw OutOfMemory(what + ": its factor" + size + " is too large for 32-bit indices");
    throw Error(what + " (status " + std::to_string(common.status) + ")");
  }
};

namespace {

/// Operations an entry of L, from which on a copy in single precision, and a factor made so, gain more than
/// they take.
constexpr double some_work = 55, much_work = 100;
/// Operations of a factor, for which BLAS gains nothing that its buffer of 128 MB would be worth.
constexpr double few_operations = 1e6;

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

}  // namespace

Cholesky::Cholesky() : factor_(std::make_unique<Factor>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

void Cholesky::Factor::analyze(const SparseMatrix& lower, std::optional<int> ordering, const int* order) {
  cholmod_free_factor(&L, &common);
  is_analyzed = lower.rows() == 0;
  failed = -1;
  tree.reset();
  entries = {};
  upper = {};
  waiting = {};
  forget_rough();
  if (lower.rows() == 0) return;
  cholmod_sparse A = view_of_lower(lower);
  const int n_methods = std::exchange(common.nmethods, ordering ? 1 : common.nmethods);
  const int before = std::exchange(common.method[0].ordering, ordering.value_or(common.method[0].ordering));
  L = cholmod_analyze_p(&A, const_cast<int*>(order), nullptr, 0, &common);
  common.nmethods = n_methods;
  common.method[0].ordering = before;
  check("analyze", lower.rows());
  tree.emplace(*L);
  find_places(lower);
  solution_of_groups.analyze(*L);
  is_analyzed = true;
}

void Cholesky::Factor::find_places(const SparseMatrix& lower) {
  const int n = static_cast<int>(L->n);
  const int *const order = static_cast<const int*>(L->Perm), *const outer = lower.outerIndexPtr(),
                   *const inner = lower.innerIndexPtr();
  std::vector<int> row_of(L->n), group_of(L->n);  // in the order of elimination
  for (int k = 0; k < n; ++k) row_of[order[k]] = k;
  for (int s = 0; s < tree->n_groups(); ++s)
    std::fill_n(group_of.begin() + tree->first_column(s), tree->n_columns(s), s);
  place.resize(static_cast<std::size_t>(outer[n]));
  for (int c = 0; c < n; ++c)
    for (int k = outer[c]; k < outer[c + 1]; ++k) {
      const int of_c = row_of[c], of_row = row_of[inner[k]];
      const auto [column, row] = std::minmax({of_c, of_row});
      const int s = group_of[column];
      const std::span<const int> rows = tree->rows(s);
      const std::ptrdiff_t n_rows = std::ssize(rows), at = std::ranges::lower_bound(rows, row) - rows.begin();
      place[k] = static_cast<int>(tree->first_entry(s) + (column - tree->first_column(s)) * n_rows + at);
      if (of_row < of_c) place[k] = ~place[k];
    }
}

void Cholesky::analyze(const SparseMatrix& lower) {
  ++work_.n_analyses;
  const Stopwatch watch(work_.analysis);
  factor_->analyze(lower, std::nullopt);
}

void Cholesky::dissect(const SparseMatrix& lower) {
  ++work_.n_analyses;
  const Stopwatch watch(work_.analysis);
  factor_->analyze(lower, CHOLMOD_METIS);
}

void Cholesky::analyze(const SparseMatrix& lower, std::span<const int> order) {
  assert(static_cast<Index>(order.size()) == lower.rows());
  ++work_.n_analyses;
  const Stopwatch watch(work_.analysis);
  factor_->analyze(lower, CHOLMOD_GIVEN, order.data());
}

bool Cholesky::factorize(const SparseMatrix& lower) {
  return factorize(lower, nullptr);
}

bool Cholesky::factorize(const SparseMatrix& lower, const VectorXd& more_above) {
  assert(more_above.size() == lower.nonZeros());
  return factorize(lower, &more_above);
}

bool Cholesky::factorize(const SparseMatrix& lower, const VectorXd* more_above) {
  ++work_.n_factorizations;
  const Stopwatch watch(work_.factorization);
  if (lower.rows() == 0) return true;
  Factor& f = *factor_;
  assert(f.is_analyzed && static_cast<Index>(f.L->n) == lower.rows() &&
         std::ssize(f.place) == lower.nonZeros());
  f.outdate_rough();
  f.failed = -1;
  f.is_symmetric = !more_above;
  const auto clear = [&](LargeVector<double>& entries) {
    if (entries.empty())
      entries = LargeVector<double>(f.L->xsize);
    else
      std::ranges::fill(entries, 0);
  };
  const bool by_blas = f.common.fl > few_operations;
  if (by_blas)
    expect_room_for_blas(sizeof(double) * ((more_above ? 2 : 1) * f.L->xsize +
                                           static_cast<std::size_t>(f.tree->most_waiting())));
  try {
    clear(f.entries);
    if (more_above) clear(f.upper);
    if (f.waiting.empty()) f.waiting = LargeVector<double>(static_cast<std::size_t>(f.tree->most_waiting()));
  } catch (const std::bad_alloc&) {
    f.common.status = CHOLMOD_OUT_OF_MEMORY;
    f.check("factorize", lower.rows());
  }
  for (std::size_t k = 0; k < f.place.size(); ++k) {
    const double below = lower.valuePtr()[k];
    const int place = f.place[k] < 0 ? ~f.place[k] : f.place[k];
    if (!more_above) {
      f.entries[place] = below;
      continue;
    }
    const double above = below + (*more_above)[static_cast<Index>(k)];
    f.entries[place] = f.place[k] < 0 ? above : below;
    f.upper[place] = f.place[k] < 0 ? below : above;
  }
  double *const L = f.entries.data(), *const Ut = more_above ? f.upper.data() : L;
  Fronts<double> fronts(*f.tree, L, Ut, f.waiting, by_blas);
  for (int s = 0; s < f.tree->n_groups() && f.failed < 0; ++s)
    if (const int done = fronts.eliminate(s, 0); done < f.tree->n_columns(s))
      f.failed = f.tree->first_column(s) + done;
  return f.failed < 0;
}

bool Cholesky::factorize_roughly(const SparseMatrix& lower) {
  assert(factor_->L || lower.rows() == 0);
  if (lower.rows() == 0 || factor_->common.fl < much_work * factor_->common.lnz) return false;
  const Stopwatch watch(work_.factorization);
  expect_room_for_blas(sizeof(float) *
                       (factor_->L->xsize + static_cast<std::size_t>(factor_->tree->most_waiting())));
  factor_->forget_rough();
  try {
    if (std::optional<SinglePrecisionFactor> made =
            single_precision_factor(*factor_->L, *factor_->tree, lower)) {
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
  factor_->solution_of_groups.solve(*factor_->L, factor_->entries, factor_->above(), b, x);
}

void Cholesky::solve_roughly(const VectorXd& b, VectorXd& x) {
  if (b.size() == 0 || (!factor_->has_rough && factor_->common.fl < some_work * factor_->common.lnz)) {
    solve(b, x);
    return;
  }
  ++work_.n_solves;
  const Stopwatch watch(work_.solution);
  SinglePrecisionFactor& rough = factor_->rough;
  if (!factor_->has_rough) {
    rough.scale.resize(0);
    rough.entries.assign(factor_->entries.begin(), factor_->entries.end());
    if (!factor_->is_symmetric) factor_->rough_upper.assign(factor_->upper.begin(), factor_->upper.end());
    factor_->has_rough = true;
  }
  if (rough.scale.size() == 0) {
    factor_->solution_of_groups.solve(*factor_->L, rough.entries,
                                      factor_->is_symmetric ? rough.entries : factor_->rough_upper, b, x);
    return;
  }
  factor_->solution_of_groups.solve(*factor_->L, rough.entries, rough.entries, b.cwiseProduct(rough.scale),
                                    x);
  x.array() *= rough.scale.array();
}

bool Cholesky::is_analyzed() const {
  return factor_->is_analyzed;
}

int Cholesky::failed_row() const {
  return factor_->failed < 0 ? -1 : static_cast<const int*>(factor_->L->Perm)[factor_->failed];
}

double Cholesky::memory() const {
  const Factor& f = *factor_;
  return static_cast<double>(f.common.memory_inuse) + f.rough.memory() + f.solution_of_groups.memory() +
         (f.tree ? f.tree->memory() : 0) +
         static_cast<double>(sizeof(int) * f.place.capacity() + sizeof(float) * f.rough_upper.capacity() +
                             sizeof(double) *
                                 (f.entries.capacity() + f.upper.capacity() + f.waiting.capacity()));
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
