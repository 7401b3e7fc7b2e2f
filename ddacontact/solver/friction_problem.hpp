/// \file The problem of a step with frozen rotations, contact normals and friction bounds.
#pragma once

#include <ddacontact/solver/contact_term.hpp>
#include <ddacontact/solver/line_search.hpp>
#include <polyfem/assembly/pattern_matrix.hpp>

#include <optional>
#include <span>
#include <vector>

namespace ddacontact {

/// When FrictionProblem::minimize ends.
struct MinimizeOptions {
  double tolerance = 0;      ///< of the gradient; round-off passes in any case
  int max_iterations = 100;  ///< solutions
};

/// How FrictionProblem::minimize ended.
enum class MinimizeStatus { converged, iteration_limit, not_positive_definite, not_finite };

/// The end of FrictionProblem::minimize.
struct MinimizeReport {
  MinimizeStatus status = MinimizeStatus::iteration_limit;
  int iterations = 0;   ///< solutions
  double residual = 0;  ///< the largest entry of the gradient by free unknowns at the end
};

/// The potential
///   g0 . d + d . A d / 2 + sum of the contacts'
/// of unknowns d, some of them held: strictly convex when A is positive definite on the free ones, once
/// differentiable and piecewise quadratic. A is a sum of dense matrices, each over some of the unknowns.
class FrictionProblem {
 public:
  /// \param[in] equation  row of every unknown, 0 .. n_equations - 1, or -1 where it is held
  FrictionProblem(std::vector<int> equation, int n_equations);

  /// Makes room for the matrices of A, each over the unknowns listed as its rows.
  void set_matrices(polyfem::Connectivity unknowns);
  /// Must be called before other contacts than the last ones are factorized. The analysis of the factor is
  /// kept when the unknowns that meet are the same.
  void contacts_changed();
  /// The matrices of A, to be filled, and the unknowns that each is over.
  std::span<MatrixXd> elements() { return matrices_; }
  const polyfem::Connectivity& unknowns() const { return elements_; }
  /// The row of each unknown, -1: held.
  const std::vector<int>& equation() const { return equation_; }
  int n_equations() const { return n_equations_; }
  /// Must be called after A, or coefficients or stiffnesses of the contacts have changed: the last factor is
  /// another matrix's then.
  void matrices_changed() { factored_springs_.reset(); }

  /// Tells that these contacts are to be factorized many times: where that pays the equations are ordered so
  /// that factors are small, at more effort, until the contacts change.
  void order_for_many(const std::vector<ContactTerm>& contacts);

  /// Whether `factorize` leaves the last factor as it is when that is of the same matrix (it does unless told
  /// otherwise), or makes the same one again.
  void keep_factor(bool keep) { keeps_factor_ = keep; }
  /// Factorizes A + springs of the contacts, those that `active` names (see active_springs), + friction that
  /// follows normal forces; unless that is what the last factor is of: as long as `matrices_changed` says
  /// nothing, the same springs act and the same friction follows. False: not positive definite; with friction
  /// singular.
  [[nodiscard]] bool factorize(const std::vector<ContactTerm>& contacts,
                               const std::vector<unsigned char>& active,
                               const std::vector<Coupling>& couplings = {});
  /// correction = (last factorized)^-1 residual on the free unknowns, 0 on prescribed ones.
  void solve(const VectorXd& residual, VectorXd& correction);
  /// b with 0 at prescribed degrees of freedom.
  VectorXd free_part(const VectorXd& b) const;

  /// Gradient of the potential at d, of prescribed degrees of freedom too.
  void compute_residual(const std::vector<ContactTerm>& contacts, const VectorXd& g0, const VectorXd& d,
                        VectorXd& residual) const;
  /// Moves the free unknowns of d to where the potential is least: Newton's method, the minimum along each
  /// direction taken exactly, so that the potential falls in every iteration. Where A is positive definite it
  /// ends after finitely many iterations, up to round-off.
  MinimizeReport minimize(const std::vector<ContactTerm>& contacts, const VectorXd& g0,
                          const MinimizeOptions& options, VectorXd& d);

  const polyfem::Cholesky& cholesky() const { return cholesky_; }

 private:
  void set_pattern(const std::vector<ContactTerm>& contacts);
  bool is_round_off(const std::vector<ContactTerm>& contacts, const VectorXd& g0, const VectorXd& d);
  double step_length(const std::vector<ContactTerm>& contacts, const VectorXd& d);

  std::vector<int> equation_;
  int n_equations_;
  /// Calls visit(e, unknowns of e) for every matrix of A.
  template <class Visit>
  void for_elements(Visit&& visit) const {
    for (int e = 0; e < elements_.n_elements(); ++e) visit(e, elements_.rows_of(e));
  }

  polyfem::Connectivity elements_;
  std::vector<MatrixXd> matrices_;
  polyfem::PatternMatrix matrix_;
  polyfem::Cholesky cholesky_;
  bool keeps_factor_ = true;
  bool has_pattern_ = false;                                    ///< matrix_ is that of the present contacts
  bool is_dissected_ = false;                                   ///< equations are ordered for many factors
  std::optional<std::vector<unsigned char>> factored_springs_;  ///< none: nothing is factored
  std::vector<Coupling> factored_couplings_;
  VectorXd rhs_, solution_, residual_, step_, trial_, magnitudes_;
  std::vector<unsigned char> active_, pieces_, trial_pieces_;
};

}  // namespace ddacontact
