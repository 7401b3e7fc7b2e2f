/// \file The linear equations of Newton's method, solved in the way that costs least.
#pragma once

#include <ddacontact/core/skips.hpp>
#include <ddacontact/solver/friction_problem.hpp>

#include <vector>

namespace ddacontact {

/// Counts of a TangentSolver.
struct TangentCounts {
  int with_stale_factor = 0;  ///< solutions by Krylov iteration on an older factor
  int iterations = 0;         ///< of Krylov in those
  int fallbacks = 0;          ///< iterations that did not converge

  TangentCounts& operator+=(const TangentCounts& more) {
    with_stale_factor += more.with_stale_factor;
    iterations += more.iterations;
    fallbacks += more.fallbacks;
    return *this;
  }
};

/// y = (A + springs that act + couplings) x on the free unknowns, 0 on the held ones, where x must be 0.
/// \param[in] active     see active_springs
void multiply_tangent(FrictionProblem& problem, const std::vector<ContactTerm>& contacts,
                      const std::vector<unsigned char>& active, const std::vector<Coupling>& couplings,
                      const VectorXd& x, VectorXd& y);

/// Solves (A + springs that act + friction that follows normal forces) x = b: where few springs changed since
/// the last factor of the step with that as preconditioner; else with a factor of its own. An iteration that
/// does not converge is left for the factor, and none is tried again.
class TangentSolver {
 public:
  /// \param[in] problem  its last factor, of an earlier step, is not used
  TangentSolver(FrictionProblem& problem, const Skips& skip) : problem_(problem), stale_(skip.stale_factor) {}

  /// x = 0 on prescribed degrees of freedom. False: the matrix is not positive definite, with friction singular.
  [[nodiscard]] bool solve(const std::vector<ContactTerm>& terms, const std::vector<unsigned char>& active,
                           const std::vector<Coupling>& couplings, const VectorXd& b, VectorXd& x);

  const TangentCounts& counts() const { return counts_; }

 private:
  /// Whether few springs changed since the last factor.
  bool serves(const std::vector<unsigned char>& springs) const;
  /// With the last factor as preconditioner. False: not to the tolerance.
  bool iterate(const std::vector<ContactTerm>& terms, const std::vector<unsigned char>& active,
               const std::vector<Coupling>& couplings, const VectorXd& b, VectorXd& x);

  FrictionProblem& problem_;
  bool stale_;  ///< whether an older factor still serves
  bool has_factor_ = false;
  std::vector<unsigned char> factored_;  ///< springs in the last factor of the step, and how friction follows
  TangentCounts counts_;
};

}  // namespace ddacontact
