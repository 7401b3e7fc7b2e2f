/// \file Unknowns with prescribed values, taken out of a symmetric system that keeps its size.
#pragma once

#include <polyfem/assembly/cholesky.hpp>

#include <vector>

namespace polyfem {

/// Which unknowns are prescribed, at what values, and what couples them to the others. Their rows and columns
/// become those of the identity, so that the pattern, and with it the analysis, serves any set of them.
class PrescribedDofs {
 public:
  explicit PrescribedDofs(int n_unknowns)
      : prescribed_(static_cast<std::size_t>(n_unknowns), 0), values_(VectorXd::Zero(n_unknowns)) {}

  /// Whether it was free before.
  bool hold(int unknown, double value);
  void release_all();
  bool is_prescribed(int unknown) const { return prescribed_[static_cast<std::size_t>(unknown)] != 0; }

  /// Puts those of the identity in place of the prescribed rows and columns of a matrix given by its lower
  /// triangle and remembers what was there.
  void take_out(SparseMatrix& lower);
  /// Puts back what was taken out.
  void put_back(SparseMatrix& lower);
  /// Forgets what was taken out: the matrix is assembled anew.
  void forget_couplings() { couplings_.clear(); }

  /// The right hand side for the matrix without held rows and columns.
  void move_to_right_hand_side(VectorXd& f) const;
  /// The exact values at prescribed degrees of freedom, in a solution.
  void set_values(VectorXd& u) const;
  /// K u of the whole matrix at prescribed degrees of freedom; zero elsewhere.
  VectorXd forces(const VectorXd& u) const;

 private:
  /// An entry of the lower triangle that was replaced.
  struct Coupling {
    int row, column, slot;
    double value;
  };

  std::vector<char> prescribed_;
  VectorXd values_;
  std::vector<Coupling> couplings_;
};

}  // namespace polyfem
