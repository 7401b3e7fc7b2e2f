/// \file A system with ties, or without symmetry, in the unknowns that are left.
#pragma once

#include <polyfem/assembly/lu.hpp>
#include <polyfem/assembly/tied_unknowns.hpp>

namespace polyfem {

/// T^T A (T q + g) = T^T f: by Cholesky's factor of T^T A T where A is symmetric, by UMFPACK's where it is
/// not.
class ReducedSystem {
 public:
  /// Takes the matrix of all unknowns, both triangles, and makes the factor. False: T^T A T is not positive
  /// definite, or without symmetry singular to round-off.
  [[nodiscard]] bool set(SparseMatrix A, Reduction reduction, bool symmetric);
  /// All unknowns under the loads f.
  VectorXd solve(const VectorXd& f);
  /// A u - f where constraints act: at unknowns that are held, tied or followed; zero elsewhere.
  VectorXd reactions(const VectorXd& u, const VectorXd& f) const;
  /// The unknown at which the last factor was not made; -1: none in particular.
  int failed_unknown() const;

 private:
  SparseMatrix A_, T_;
  VectorXd g_;
  bool symmetric_ = true;
  Cholesky cholesky_;
  Lu lu_;
};

}  // namespace polyfem
