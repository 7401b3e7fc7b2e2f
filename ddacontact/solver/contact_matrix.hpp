/// \file The matrix of a linearized contact problem, K = A + H_n' D_n H_n + H_t' (D_t H_t + D_tn H_n), and
/// its factors.
#pragma once

#include <ddacontact/solver/contact_problem.hpp>
#include <polyfem/assembly/sparse_lu.hpp>

#include <Eigen/LU>

#include <array>
#include <vector>

namespace ddacontact {

/// By how much a contact's impulses fall with its rates: -dp/du, -dq/dv and, by friction, -dq/du.
struct ContactStiffness {
  double normal = 0, shear = 0, shear_by_normal = 0;
};

/// K of one island: the pattern is found once, the factors as often as stiffnesses change. Few unknowns are
/// solved for densely.
class ContactMatrix {
 public:
  explicit ContactMatrix(const ContactProblem& problem);

  /// \param[in] stiffness  of the contacts. \return false where K is singular: nothing to solve with then
  [[nodiscard]] bool factorize(const std::vector<ContactStiffness>& stiffness);
  /// K^-1 b with the last factors.
  VectorXd solve(const VectorXd& b);

 private:
  /// Where the entries of two bodies begin, and how far apart their columns are.
  struct Place {
    std::size_t first = 0, stride = 0;
  };
  void place_densely();
  void place_sparsely();
  void assemble(const std::vector<ContactStiffness>& stiffness, double* values) const;

  const ContactProblem& problem_;
  VectorXd scale_;             ///< diag(A)^-1/2: K is factorized with rows and columns times these
  std::vector<Place> bodies_;  ///< of each body with itself
  std::vector<std::array<Place, 4>> contacts_;  ///< of sides 0-0, 0-1, 1-0, 1-1: row, column
  bool dense_;
  MatrixXd dense_matrix_;
  Eigen::PartialPivLU<MatrixXd> dense_factors_;
  polyfem::SparseMatrix matrix_;
  polyfem::SparseLu factors_;
};

}  // namespace ddacontact
