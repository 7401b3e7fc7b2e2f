#include <polyfem/assembly/lu.hpp>

#include <polyfem/core/error.hpp>

#include <umfpack.h>

#include <array>
#include <limits>
#include <new>
#include <string>
#include <utility>

namespace polyfem {

struct Lu::Factors {
  SparseMatrix A;
  void *symbolic = nullptr, *numeric = nullptr;
  std::array<double, UMFPACK_CONTROL> control{};
  std::array<double, UMFPACK_INFO> info{};

  Factors() { umfpack_di_defaults(control.data()); }
  ~Factors() { free(); }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
  void free() {
    umfpack_di_free_symbolic(&symbolic);
    umfpack_di_free_numeric(&numeric);
  }
  /// Throws for what is neither success nor a singular matrix.
  void require(int status) const {
    if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
    if (status != UMFPACK_OK && status != UMFPACK_WARNING_singular_matrix)
      throw Error("UMFPACK refuses a matrix with status " + std::to_string(status));
  }
};

Lu::Lu() : factors_(std::make_unique<Factors>()) {}
Lu::~Lu() = default;
Lu::Lu(Lu&&) noexcept = default;
Lu& Lu::operator=(Lu&&) noexcept = default;

bool Lu::factorize(SparseMatrix A) {
  Factors& f = *factors_;
  f.free();
  f.A = std::move(A);
  f.A.makeCompressed();
  const int n = static_cast<int>(f.A.rows());
  const int* const columns = f.A.outerIndexPtr();
  const int* const rows = f.A.innerIndexPtr();
  const double* const values = f.A.valuePtr();
  f.require(umfpack_di_symbolic(n, n, columns, rows, values, &f.symbolic, f.control.data(), f.info.data()));
  f.require(
      umfpack_di_numeric(columns, rows, values, f.symbolic, &f.numeric, f.control.data(), f.info.data()));
  return f.info[UMFPACK_RCOND] > n * std::numeric_limits<double>::epsilon();  // round-off grows with n
}

void Lu::solve(const VectorXd& b, VectorXd& x) const {
  Factors& f = *factors_;
  x.resize(b.size());
  f.require(umfpack_di_solve(UMFPACK_A, f.A.outerIndexPtr(), f.A.innerIndexPtr(), f.A.valuePtr(), x.data(),
                             b.data(), f.numeric, f.control.data(), f.info.data()));
}

}  // namespace polyfem
