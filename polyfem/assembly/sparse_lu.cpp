#include <polyfem/assembly/blas.hpp>
#include <polyfem/assembly/sparse_lu.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/core/out_of_memory.hpp>

#include <umfpack.h>

#include <cassert>
#include <string>

namespace polyfem {

/// What UMFPACK allocates and frees.
struct SparseLu::Factors {
  double control[UMFPACK_CONTROL]{};
  void *symbolic = nullptr, *numeric = nullptr;
  std::vector<int> work_indices;
  std::vector<double> work;

  Factors() {
    umfpack_di_defaults(control);
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control[UMFPACK_SCALE] = UMFPACK_SCALE_NONE;  // of rows alone: it would spoil the order of the pivots
    control[UMFPACK_IRSTEP] = 0;                  // callers refine with the operator that they have
  }
  ~Factors() {
    umfpack_di_free_numeric(&numeric);
    umfpack_di_free_symbolic(&symbolic);
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
};

namespace {

void check(int status, const char* action, Index n_rows) {
  if (status == UMFPACK_OK || status == UMFPACK_WARNING_singular_matrix) return;
  const std::string what =
      std::string("UMFPACK could not ") + action + " a matrix of " + std::to_string(n_rows) + " rows";
  if (status == UMFPACK_ERROR_out_of_memory) throw OutOfMemory(what + ": not enough memory for its factors");
  throw Error(what + " (status " + std::to_string(status) + ")");
}

}  // namespace

SparseLu::SparseLu() : factors_(std::make_unique<Factors>()) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

void SparseLu::analyze(const SparseMatrix& matrix) {
  assert(matrix.isCompressed() && matrix.rows() == matrix.cols());
  expect_room_for_blas(0);
  umfpack_di_free_numeric(&factors_->numeric);
  umfpack_di_free_symbolic(&factors_->symbolic);
  const int n = static_cast<int>(matrix.rows());
  // Without values: what pivots are large is not known yet.
  check(umfpack_di_symbolic(n, n, matrix.outerIndexPtr(), matrix.innerIndexPtr(), nullptr,
                            &factors_->symbolic, factors_->control, nullptr),
        "analyze", n);
  factors_->work_indices.resize(static_cast<std::size_t>(n));
  factors_->work.resize(static_cast<std::size_t>(n));
}

bool SparseLu::factorize(const SparseMatrix& matrix) {
  assert(factors_->symbolic);
  umfpack_di_free_numeric(&factors_->numeric);
  const int status = umfpack_di_numeric(matrix.outerIndexPtr(), matrix.innerIndexPtr(), matrix.valuePtr(),
                                        factors_->symbolic, &factors_->numeric, factors_->control, nullptr);
  check(status, "factorize", matrix.rows());
  return status == UMFPACK_OK;
}

void SparseLu::solve(const SparseMatrix& matrix, const VectorXd& b, VectorXd& x) {
  assert(factors_->numeric && &b != &x);
  x.resize(b.size());
  check(umfpack_di_wsolve(UMFPACK_A, matrix.outerIndexPtr(), matrix.innerIndexPtr(), matrix.valuePtr(),
                          x.data(), b.data(), factors_->numeric, factors_->control, nullptr,
                          factors_->work_indices.data(), factors_->work.data()),
        "solve with", matrix.rows());
}

}  // namespace polyfem
