#include <ddacontact/solver/augmented_lagrangian.hpp>
#include <ddacontact/solver/contact_operators.hpp>

namespace ddacontact {

namespace {

/// Penalties times responses: as large as Newton's method bears from the end of an interior-point method.
constexpr double kappa = 1e5;
/// Solutions with the same factors for each factorization, at most.
constexpr long solutions_a_factor = 5;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// A subproblem: velocities, and impulses as a function of them.
class Subproblem {
 public:
  explicit Subproblem(ContactProblem& problem)
      : problem_(problem), n_(problem.n_contacts()), D_n_(n_), D_t_(n_), p_(n_), q_(n_) {
    stiffness_.resize(index(n_));
    for (int c = 0; c < n_; ++c) {
      const CoulombLaw& law = problem.law(c);
      D_n_[c] = 1 / (law.normal_compliance + problem.response(c).normal / kappa);
      D_t_[c] = 1 / (law.shear_compliance + problem.response(c).shear / kappa);
    }
    start();
  }
  /// Begins from problem.impulses.
  void start() {
    z_ = problem_.velocity();
    start_ = problem_.impulses;
    measure();
  }
  /// Impulses and their derivatives at z. \return whether any contact changed its state
  bool evaluate();
  /// Newton's step for the last derivatives, as long as it gains. \return its length; 0: no way on
  double step(ContactMatrix& matrix, bool factorize, ContactSolverCounts& counts);
  void store() {
    for (int c = 0; c < n_; ++c) problem_.impulses[index(c)] = {p_[c], q_[c]};
  }

 private:
  void measure() {
    contact_rates(problem_, z_, u_, v_);
    for (int c = 0; c < n_; ++c) {
      u_[c] += problem_.offsets[index(c)].normal;
      v_[c] += problem_.offsets[index(c)].shear;
    }
  }
  NormalAndShear trial(int c, double u, double v) const {
    const CoulombLaw& law = problem_.law(c);
    const NormalAndShear& p = start_[index(c)];
    return {p.normal - D_n_[c] * (u + law.normal_compliance * p.normal),
            p.shear - D_t_[c] * (v + law.shear_compliance * p.shear)};
  }
  double line_search(double slope, const VectorXd& dz, const VectorXd& hu, const VectorXd& hv) const;

  ContactProblem& problem_;
  int n_;
  VectorXd D_n_, D_t_, z_, u_, v_, p_, q_;
  std::vector<NormalAndShear> start_;
  std::vector<ContactStiffness> stiffness_;
};

bool Subproblem::evaluate() {
  bool changed = false;
  for (int c = 0; c < n_; ++c) {
    const CoulombLaw& law = problem_.law(c);
    const NormalAndShear free = trial(c, u_[c], v_[c]), p = law.project(free);
    p_[c] = p.normal;
    q_[c] = p.shear;
    ContactStiffness D;
    if (law.bonded || p.normal > 0) {
      D.normal = D_n_[c];
      if (p.shear == free.shear)
        D.shear = law.has_friction() ? D_t_[c] : 0;
      else if (law.has_friction())
        D.shear_by_normal = (p.shear < free.shear ? 1 : -1) * law.bound_rate(p.normal) * D_n_[c];
    }
    ContactStiffness& before = stiffness_[index(c)];
    changed = changed || D.normal != before.normal || D.shear != before.shear ||
              D.shear_by_normal != before.shear_by_normal;
    before = D;
  }
  return changed;
}

/// The length in (0, 1] at which the step dz no longer gains: dz . (H' P - A (z - z_free)) = 0.
double Subproblem::line_search(double slope, const VectorXd& dz, const VectorXd& hu,
                               const VectorXd& hv) const {
  const VectorXd A_dz = mass_times(problem_, dz);
  const double inertia = A_dz.dot(dz), there = A_dz.dot(z_ - problem_.free_velocity());
  const auto gain = [&](double length) {
    double sum = -there - length * inertia;
    for (int c = 0; c < n_; ++c) {
      const NormalAndShear p =
          problem_.law(c).project(trial(c, u_[c] + length * hu[c], v_[c] + length * hv[c]));
      sum += hu[c] * p.normal + hv[c] * p.shear;
    }
    return sum;
  };
  double low = 0, high = 1, g_low = slope, g_high = gain(1);
  constexpr double enough = 0.1;
  constexpr int max_evaluations = 30;
  if (g_high >= -enough * slope) return 1;
  double middle = 1;
  for (int i = 0; i < max_evaluations; ++i) {
    // Regula falsi that halves where it would creep.
    middle = i % 2 == 0 ? low + (high - low) * g_low / (g_low - g_high) : 0.5 * (low + high);
    const double g = gain(middle);
    if (std::abs(g) <= enough * slope) break;
    (g > 0 ? low : high) = middle;
    (g > 0 ? g_low : g_high) = g;
  }
  return middle;
}

double Subproblem::step(ContactMatrix& matrix, bool factorize, ContactSolverCounts& counts) {
  VectorXd g = mass_times(problem_, problem_.free_velocity() - z_);
  add_impulses(problem_, p_, q_, g);
  for (const bool coupled : {true, false}) {
    if (!coupled)
      for (ContactStiffness& D : stiffness_) D.shear_by_normal = 0;
    if (factorize || !coupled) {
      ++counts.factorizations;
      if (!matrix.factorize(stiffness_)) continue;
    }
    const VectorXd dz = matrix.solve(g);
    ++counts.newton_iterations;
    const double slope = g.dot(dz);
    if (!(slope > 0)) continue;
    VectorXd hu, hv;
    contact_rates(problem_, dz, hu, hv);
    const double length = line_search(slope, dz, hu, hv);
    z_ += length * dz;
    measure();
    return length;
  }
  return 0;
}

}  // namespace

ContactResidual augmented_lagrangian(ContactProblem& problem, ContactMatrix& matrix, double required,
                                     int max_factorizations, ContactSolverCounts& counts) {
  std::vector<NormalAndShear> best = problem.impulses;
  ContactResidual least = residual(problem, problem.velocity());
  Subproblem sub(problem);
  const long last_factor = counts.factorizations + max_factorizations,
             last_solution = counts.newton_iterations + solutions_a_factor * max_factorizations;
  sub.evaluate();
  bool changed = true;
  while (least.relative > required && counts.factorizations < last_factor &&
         counts.newton_iterations < last_solution) {
    const double length = sub.step(matrix, changed, counts);
    if (length == 0) break;
    changed = sub.evaluate();
    if (changed || length < 1) continue;
    sub.store();
    const ContactResidual left = residual(problem, problem.velocity());
    if (left.relative < least.relative) {
      least = left;
      best = problem.impulses;
    }
    sub.start();
    changed = sub.evaluate();
  }
  problem.impulses = best;
  return least;
}

}  // namespace ddacontact
