/// \file The matrix of a tangent as what it makes of vectors.
#pragma once

#include <ddacontact/solver/friction_problem.hpp>

#include <vector>

namespace ddacontact {

/// A + springs that act + couplings, gathered for many products.
class TangentOperator {
 public:
  /// \param[in] problem    its matrices must stay as they are
  /// \param[in] active     see active_springs
  /// \param[in] couplings  each of the gap and the slip of one contact
  TangentOperator(FrictionProblem& problem, const std::vector<ContactTerm>& contacts,
                  const std::vector<unsigned char>& active, const std::vector<Coupling>& couplings);

  /// y = matrix x on the free unknowns, 0 on the held ones, where x must be 0.
  void multiply(const VectorXd& x, VectorXd& y) const;

 private:
  /// normal * a a^T + shear * b b^T + mixed * b a^T, of entries up to `end`.
  struct Springs {
    int end;
    double normal, shear, mixed;
  };
  struct Entry {
    int unknown;
    double a, b;  ///< coefficients of the gap and of the slip
  };
  void add(const AffineForm& gap, const AffineForm& slip, double normal, double shear, double mixed);

  FrictionProblem& problem_;
  std::vector<Springs> springs_;
  std::vector<Entry> entries_;
};

}  // namespace ddacontact
