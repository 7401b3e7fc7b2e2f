#include <ddacontact/contact/joint_law.hpp>
#include <ddacontact/solver/contact_newton.hpp>
#include <ddacontact/solver/contact_operators.hpp>

namespace ddacontact {

namespace {

/// Penalties times responses. Larger: fewer repetitions with the same factors; the factors lose as many
/// digits.
constexpr double kappa = 1e7;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// The iteration's variables, and one method for each of its parts.
class Newton {
 public:
  Newton(ContactProblem& problem, ContactMatrix& matrix, double target, ContactSolverCounts& counts)
      : problem_(problem),
        matrix_(matrix),
        target_(target),
        counts_(counts),
        states_(index(problem.n_contacts()), ContactState::open),
        stiffness_(index(problem.n_contacts())),
        z_(problem.velocity()) {}

  /// States by the natural map, from any impulses.
  void guess_states() {
    for (int c = 0; c < problem_.n_contacts(); ++c) states_[index(c)] = closing_state(c);
  }
  /// States after a solution: each is kept unless it is violated. \return whether any changed
  bool update_states() {
    const std::vector<double> sums = impulse_sums(problem_);
    bool changed = false;
    for (int c = 0; c < problem_.n_contacts(); ++c) {
      const ContactState next = next_state(c, target_ * impulse_sum(problem_, sums, c));
      changed = changed || next != states_[index(c)];
      states_[index(c)] = next;
    }
    return changed;
  }
  [[nodiscard]] bool factorize();
  /// One linear system: impulses of the states, and z.
  void step();

  const VectorXd& velocity() const { return z_; }

 private:
  ContactState closing_state(int c) const;
  ContactState next_state(int c, double tolerance) const;
  void project(int c);

  ContactProblem& problem_;
  ContactMatrix& matrix_;
  double target_;
  ContactSolverCounts& counts_;
  std::vector<ContactState> states_;
  std::vector<ContactStiffness> stiffness_;
  VectorXd z_;
};

ContactState Newton::closing_state(int c) const {
  const CoulombLaw& law = problem_.law(c);
  if (law.bonded) return ContactState::stick;
  const NormalAndShear& impulse = problem_.impulses[index(c)];
  const NormalAndShear rate = problem_.rates(c, z_), &w = problem_.response(c);
  const double p = impulse.normal - (rate.normal + law.normal_compliance * impulse.normal) /
                                        (w.normal + law.normal_compliance),
               q = impulse.shear -
                   (rate.shear + law.shear_compliance * impulse.shear) / (w.shear + law.shear_compliance);
  if (p <= 0) return ContactState::open;
  if (!law.has_friction()) return ContactState::slip_forward;
  if (std::abs(q) <= law.bound(p)) return ContactState::stick;
  return q < 0 ? ContactState::slip_forward : ContactState::slip_backward;
}

ContactState Newton::next_state(int c, double tolerance) const {
  const CoulombLaw& law = problem_.law(c);
  if (law.bonded) return ContactState::stick;
  const NormalAndShear& impulse = problem_.impulses[index(c)];
  const NormalAndShear rate = problem_.rates(c, z_), &w = problem_.response(c);
  const ContactState state = states_[index(c)];
  if (state == ContactState::open)
    return -rate.normal > tolerance * (w.normal + law.normal_compliance) ? closing_state(c) : state;
  if (impulse.normal < -tolerance) return ContactState::open;
  if (!law.has_friction()) return state;
  if (state == ContactState::stick) {
    if (std::abs(impulse.shear) <= law.bound(impulse.normal) + tolerance) return state;
    return impulse.shear < 0 ? ContactState::slip_forward : ContactState::slip_backward;
  }
  const double v = rate.shear + law.shear_compliance * impulse.shear;
  return v * slip_sign(state) < -tolerance * (w.shear + law.shear_compliance) ? ContactState::stick : state;
}

/// The impulses that the state starts from.
void Newton::project(int c) {
  const CoulombLaw& law = problem_.law(c);
  NormalAndShear& impulse = problem_.impulses[index(c)];
  if (law.bonded) return;
  if (states_[index(c)] == ContactState::open) impulse = {};
  impulse.normal = std::max(impulse.normal, 0.0);
  if (is_slipping(states_[index(c)]))
    impulse.shear = -slip_sign(states_[index(c)]) * law.bound(impulse.normal);
}

bool Newton::factorize() {
  for (int c = 0; c < problem_.n_contacts(); ++c) {
    ContactStiffness& D = stiffness_[index(c)] = {};
    const ContactState state = states_[index(c)];
    if (state == ContactState::open) continue;
    const CoulombLaw& law = problem_.law(c);
    const NormalAndShear& w = problem_.response(c);
    D.normal = 1 / (law.normal_compliance + w.normal / kappa);
    if (state == ContactState::stick)
      D.shear = 1 / (law.shear_compliance + w.shear / kappa);
    else if (law.has_friction())
      D.shear_by_normal = -slip_sign(state) * law.bound_rate(problem_.impulses[index(c)].normal) * D.normal;
  }
  ++counts_.factorizations;
  return matrix_.factorize(stiffness_);
}

void Newton::step() {
  const int n = problem_.n_contacts();
  for (int c = 0; c < n; ++c) project(c);
  z_ = problem_.velocity();
  VectorXd dp = VectorXd::Zero(n), dq = VectorXd::Zero(n);
  for (int c = 0; c < n; ++c) {
    const CoulombLaw& law = problem_.law(c);
    const NormalAndShear rate = problem_.rates(c, z_), impulse = problem_.impulses[index(c)];
    const auto [D_n, D_t, D_tn] = stiffness_[index(c)];
    const double u = rate.normal + law.normal_compliance * impulse.normal;
    dp[c] = -D_n * u;
    dq[c] = -D_t * (rate.shear + law.shear_compliance * impulse.shear) - D_tn * u;
  }
  VectorXd right = VectorXd::Zero(problem_.n_unknowns()), u, v;
  add_impulses(problem_, dp, dq, right);
  contact_rates(problem_, matrix_.solve(right), u, v);
  for (int c = 0; c < n; ++c) {
    const auto [D_n, D_t, D_tn] = stiffness_[index(c)];
    problem_.impulses[index(c)].normal += dp[c] - D_n * u[c];
    problem_.impulses[index(c)].shear += dq[c] - D_t * v[c] - D_tn * u[c];
  }
  z_ = problem_.velocity();
  ++counts_.newton_iterations;
}

}  // namespace

ContactResidual newton(ContactProblem& problem, ContactMatrix& matrix, double required, double target,
                       int max_factorizations, ContactSolverCounts& counts) {
  Newton method(problem, matrix, target, counts);
  std::vector<NormalAndShear> best = problem.impulses, iterate;
  ContactResidual least = residual(problem, method.velocity());
  method.guess_states();
  bool changed = true;
  int n_factorizations = 0;
  while (least.relative > target) {
    if (changed) {
      if (n_factorizations == max_factorizations || (n_factorizations > 0 && least.relative <= required))
        break;
      ++n_factorizations;
      if (!method.factorize()) break;
    }
    method.step();
    iterate = problem.impulses;
    for (int c = 0; c < problem.n_contacts(); ++c)
      problem.impulses[index(c)] = problem.law(c).project(problem.impulses[index(c)]);
    const ContactResidual left = residual(problem, problem.velocity());
    // Without progress and with the same states it would go on for ever.
    constexpr double progress = 0.5;
    const bool better = left.relative < least.relative, enough = left.relative < progress * least.relative;
    if (better) {
      least = left;
      best = problem.impulses;
    }
    problem.impulses = iterate;
    changed = method.update_states();
    if (!changed && !enough) break;
  }
  problem.impulses = best;
  return least;
}

}  // namespace ddacontact
