/// \file The linear equations of Newton's method, solved in the way that costs least.
#pragma once

#include <ddacontact/core/skips.hpp>
#include <ddacontact/solver/tangent_sweeps.hpp>

namespace ddacontact {

/// What a TangentSolver has done.
struct TangentCounts {
  int without_factor = 0;     ///< solutions by Krylov iteration on the blocks' own inverses
  int with_stale_factor = 0;  ///< solutions by Krylov iteration on an older factor
  int iterations = 0;         ///< of Krylov in both
  /// Solutions of those two kinds that did not get there, and were made by a factor; and by factors, with
  /// friction that was not found to the tolerance.
  int fallbacks = 0;

  TangentCounts& operator+=(const TangentCounts& more) {
    without_factor += more.without_factor;
    with_stale_factor += more.with_stale_factor;
    iterations += more.iterations;
    fallbacks += more.fallbacks;
    return *this;
  }
};

/// Solves (A + springs that act + friction that follows normal forces) x = b: where a step is local without a
/// factor; where few springs changed since the last factor of the step with that as preconditioner; else with
/// a factor of the springs that act. An iteration that does not converge is left for the factor, and so are
/// many iterations for few equations, for the rest of the step.
class TangentSolver {
 public:
  /// \param[in] problem  its last factor, of an earlier step, is not used
  /// \param[in] local    inertia dominates
  TangentSolver(FrictionProblem& problem, const Skips& skip, bool local);

  /// x = 0 on held unknowns. False: the matrix is not positive definite.
  /// \param[in] enough  of |b|: Krylov iterations without a factor need not leave less
  [[nodiscard]] bool solve(const std::vector<ContactTerm>& terms, const std::vector<unsigned char>& active,
                           const std::vector<Coupling>& couplings, const VectorXd& b, double enough,
                           VectorXd& x);

  /// Blocks as sweeps run through them where the step is local. nullptr: they cannot be swept.
  /// \param[in] terms  contacts of the step
  const BlockGroups* groups(const std::vector<ContactTerm>& terms);

  const TangentCounts& counts() const { return counts_; }

 private:
  bool solve_without_factor(const std::vector<ContactTerm>& terms, const std::vector<unsigned char>& active,
                            const std::vector<Coupling>& couplings, const VectorXd& b, double enough,
                            VectorXd& x);
  bool solve_with_stale_factor(const std::vector<ContactTerm>& terms,
                               const std::vector<unsigned char>& active,
                               const std::vector<Coupling>& couplings, const VectorXd& b, VectorXd& x);

  FrictionProblem& problem_;
  bool stale_, local_;
  bool has_factor_ = false;
  std::vector<unsigned char> factored_;  ///< springs in the last factor of the step
  BlockGroups groups_;
  TangentSweeps sweeps_;
  TangentCounts counts_;
};

}  // namespace ddacontact
