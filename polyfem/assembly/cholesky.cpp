#include <polyfem/assembly/blas.hpp>
#include <polyfem/assembly/cholesky.hpp>
#include <polyfem/assembly/fronts.hpp>
#include <polyfem/assembly/supernodal_solution.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/core/out_of_memory.hpp>
#include <polyfem/core/stopwatch.hpp>

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
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
  LargeVector<double> upper;  ///< entries of U^T, of the last unsymmetric K
  bool is_symmetric = true;   ///< the factor is L L^T
  int failed = -1;            ///< the column whose pivot did not serve
  SupernodalSolution solution_of_groups;
  /// Entries of L L^T = S K S in single precision, S diagonal such that S K S has ones on its diagonal; empty:
  /// the last factor is in double precision.
  LargeVector<float> rough;
  VectorXd rough_scale;  ///< the diagonal of S

  Factor() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
  }
  ~Factor() {
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }
  void forget_rough() {
    rough = {};
    rough_scale.resize(0);
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

/// Operations an entry of L, from which on a factor in single precision takes less time.
constexpr double much_work = 100;
/// Operations of a factor, for which BLAS gains nothing that its buffer of 128 MB would be worth.
constexpr double few_operations = 1e6;

/// Eliminates all groups. Returns the column whose pivot did not serve; -1: all did.
template <class Real>
int eliminate(const FrontTree& tree, Fronts<Real> fronts, Real least) {
  for (int s = 0; s < tree.n_groups(); ++s)
    if (const int done = fronts.eliminate(s, least); done < tree.n_columns(s))
      return tree.first_column(s) + done;
  return -1;
}

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
  solution_of_groups.analyze(*tree);
  is_analyzed = true;
}

void Cholesky::Factor::find_places(const SparseMatrix& lower) {
  const int n = tree->n_rows(), *const outer = lower.outerIndexPtr(), *const inner = lower.innerIndexPtr();
  std::vector<int> row_of(n);  // in the order of elimination
  for (int k = 0; k < n; ++k) row_of[tree->original_row(k)] = k;
  place.resize(static_cast<std::size_t>(outer[n]));
  for (int c = 0; c < n; ++c)
    for (int k = outer[c]; k < outer[c + 1]; ++k) {
      const int of_c = row_of[c], of_row = row_of[inner[k]];
      const auto at = static_cast<int>(tree->place_of(std::max(of_c, of_row), std::min(of_c, of_row)));
      place[k] = of_row < of_c ? ~at : at;
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
  f.forget_rough();
  f.failed = -1;
  f.is_symmetric = !more_above;
  const auto clear = [&](LargeVector<double>& entries) {
    if (entries.empty())
      entries = LargeVector<double>(f.tree->n_entries());
    else
      std::ranges::fill(entries, 0);
  };
  const bool by_blas = f.common.fl > few_operations;
  if (by_blas)
    expect_room_for_blas(sizeof(double) * ((more_above ? 2 : 1) * f.tree->n_entries() +
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
  f.failed = eliminate(*f.tree, Fronts<double>(*f.tree, L, Ut, f.waiting, by_blas), 0.);
  return f.failed < 0;
}

bool Cholesky::factorize_roughly(const SparseMatrix& lower) {
  Factor& f = *factor_;
  assert(f.L || lower.rows() == 0);
  if (lower.rows() == 0 || f.common.fl < much_work * f.common.lnz) return false;
  const Stopwatch watch(work_.factorization);
  const auto most_waiting = static_cast<std::size_t>(f.tree->most_waiting());
  expect_room_for_blas(sizeof(float) * (f.tree->n_entries() + most_waiting));
  f.forget_rough();
  const VectorXd diagonal = lower.diagonal();
  if (!(diagonal.array() > 0).all()) return false;
  f.rough_scale = diagonal.cwiseSqrt().cwiseInverse();
  bool is_made = false;
  try {
    f.rough = LargeVector<float>(f.tree->n_entries());
    LargeVector<float> waiting(most_waiting);
    for (int c = 0; c < lower.cols(); ++c)
      for (int k = lower.outerIndexPtr()[c]; k < lower.outerIndexPtr()[c + 1]; ++k)
        f.rough[f.place[k] < 0 ? ~f.place[k] : f.place[k]] = static_cast<float>(
            lower.valuePtr()[k] * f.rough_scale[c] * f.rough_scale[lower.innerIndexPtr()[k]]);
    // A pivot that has lost half of the digits: K may be ill-conditioned, or not positive definite at all.
    const float least = std::sqrt(std::numeric_limits<float>::epsilon());
    Fronts<float> fronts(*f.tree, f.rough.data(), f.rough.data(), waiting, true);
    is_made = eliminate(*f.tree, fronts, least) < 0;
  } catch (const std::bad_alloc&) {
    f.common.status = CHOLMOD_OUT_OF_MEMORY;
    f.check("factorize", lower.rows());
  }
  if (is_made)
    ++work_.n_factorizations;
  else
    f.forget_rough();
  return is_made;
}

void Cholesky::solve(const VectorXd& b, VectorXd& x) {
  ++work_.n_solves;
  const Stopwatch watch(work_.solution);
  x.resize(b.size());
  if (b.size() == 0) return;
  assert(factor_->L && static_cast<Index>(factor_->L->n) == b.size());
  factor_->solution_of_groups.solve(*factor_->tree, factor_->entries, factor_->above(), b, x);
}

void Cholesky::solve_roughly(const VectorXd& b, VectorXd& x) {
  Factor& f = *factor_;
  assert(!f.rough.empty() && b.size() == f.rough_scale.size());
  ++work_.n_solves;
  const Stopwatch watch(work_.solution);
  f.solution_of_groups.solve(*f.tree, f.rough, b.cwiseProduct(f.rough_scale), x);
  x.array() *= f.rough_scale.array();
}

bool Cholesky::is_analyzed() const {
  return factor_->is_analyzed;
}

int Cholesky::failed_row() const {
  return factor_->failed < 0 ? -1 : factor_->tree->original_row(factor_->failed);
}

double Cholesky::memory() const {
  const Factor& f = *factor_;
  return static_cast<double>(f.common.memory_inuse) + f.solution_of_groups.memory() +
         (f.tree ? f.tree->memory() : 0) +
         static_cast<double>(sizeof(int) * f.place.capacity() + sizeof(float) * f.rough.capacity() +
                             sizeof(double) *
                                 (f.entries.capacity() + f.upper.capacity() + f.waiting.capacity() +
                                  static_cast<std::size_t>(f.rough_scale.size())));
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
