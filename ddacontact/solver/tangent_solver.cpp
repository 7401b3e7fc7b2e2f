#include <ddacontact/solver/tangent_solver.hpp>

#include <ddacontact/solver/krylov.hpp>
#include <ddacontact/solver/small_product.hpp>

#include <cassert>

namespace ddacontact {

/// Of |b|: Newton's method repairs what is left.
constexpr double tolerance = 1e-4;
constexpr int most_iterations = 12;
/// A factor serves as preconditioner as long as no more than this part of the springs has changed.
constexpr double most_changed = 0.02;

void multiply_tangent(FrictionProblem& problem, const std::vector<ContactTerm>& contacts,
                      const std::vector<unsigned char>& active, const std::vector<Coupling>& couplings,
                      const VectorXd& x, VectorXd& y) {
  y.setZero(x.size());
  for (int e = 0; e < problem.unknowns().n_elements(); ++e)
    add_product(problem.elements()[e], problem.unknowns().rows_of(e), x, y);
  // normal * a a^T + shear * b b^T + mixed * b a^T
  const auto add = [&](const AffineForm& a, const AffineForm& b, double normal, double shear, double mixed) {
    const double along = a.change(x), by_a = normal * along, by_b = shear * b.change(x) + mixed * along;
    for (std::size_t k = 0; k < a.unknowns().size(); ++k)
      y[a.unknowns()[k]] +=
          by_a * a.coefficients()[k] + by_b * (k < b.coefficients().size() ? b.coefficients()[k] : 0);
  };
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (active[c] & all_act)
      add(contacts[c].gap, contacts[c].slip, active[c] & normal_acts ? contacts[c].normal_stiffness : 0,
          active[c] & shear_acts ? contacts[c].tangential_stiffness : 0, 0);
  for (const Coupling& coupling : couplings)
    add(contacts[coupling.contact].gap, contacts[coupling.contact].slip, 0, 0, coupling.rate);
  y = problem.free_part(y);
}

/// The springs that act, and which way friction follows.
std::vector<unsigned char> springs_and_senses(std::vector<unsigned char> active,
                                              const std::vector<Coupling>& couplings) {
  for (const Coupling& coupling : couplings)
    active[coupling.contact] |= coupling.rate > 0 ? at_upper : at_lower;
  return active;
}

bool TangentSolver::solve(const std::vector<ContactTerm>& terms, const std::vector<unsigned char>& active,
                          const std::vector<Coupling>& couplings, const VectorXd& b, VectorXd& x) {
  assert(active.size() == terms.size());
  std::vector<unsigned char> springs = springs_and_senses(active, couplings);
  if (stale_ && has_factor_ && serves(springs)) {
    stale_ = iterate(terms, active, couplings, b, x);
    counts_.with_stale_factor += stale_;
    if (stale_) return true;
  }
  has_factor_ = false;
  if (!problem_.factorize(terms, active, couplings)) return false;
  has_factor_ = true;
  factored_ = std::move(springs);
  problem_.solve(b, x);
  return true;
}

bool TangentSolver::serves(const std::vector<unsigned char>& springs) const {
  std::size_t n_changed = 0;
  for (std::size_t c = 0; c < springs.size(); ++c) n_changed += springs[c] != factored_[c];
  return static_cast<double>(n_changed) <= most_changed * static_cast<double>(springs.size());
}

bool TangentSolver::iterate(const std::vector<ContactTerm>& terms, const std::vector<unsigned char>& active,
                            const std::vector<Coupling>& couplings, const VectorXd& b, VectorXd& x) {
  VectorXd solved;
  const auto multiply = [&](const VectorXd& in, VectorXd& out) {
    problem_.solve_roughly(in, solved);
    multiply_tangent(problem_, terms, active, couplings, solved, out);
  };
  VectorXd forces;
  const KrylovReport report = gmres(multiply, problem_.free_part(b), tolerance, most_iterations, forces);
  problem_.solve_roughly(forces, x);
  counts_.iterations += report.iterations;
  if (!report.converged) ++counts_.fallbacks;
  return report.converged;
}

}  // namespace ddacontact
