#include <ddacontact/solver/contact_operators.hpp>
#include <ddacontact/solver/interior_point_contact.hpp>

namespace ddacontact {

namespace {

using Eigen::ArrayXd;

constexpr int max_iterations = 60;
/// Penalty of equations (bonded contacts) times their response.
constexpr double kappa = 1e7;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// Variables of the path, or their changes; of the contacts.
struct PathPoint {
  VectorXd z;
  ArrayXd p, q, y, a_plus, a_minus, l_plus, l_minus;
};

/// Right sides of the linearized products: what they are to become.
struct Targets {
  ArrayXd normal, plus, minus;
};

class InteriorPath {
 public:
  InteriorPath(ContactProblem& problem, ContactMatrix& matrix);

  /// One predictor and corrector. \return false where there is no way on
  [[nodiscard]] bool advance(ContactSolverCounts& counts);
  /// Impulses that obey the bounds.
  void store_impulses();

 private:
  void evaluate();
  PathPoint direction(const Targets& targets);
  double longest_step(const PathPoint& d) const;
  double complementarity(const PathPoint& at) const;
  PathPoint moved(const PathPoint& d, double length) const;

  ContactProblem& problem_;
  ContactMatrix& matrix_;
  int n_;
  ArrayXd bounded_, rubbing_;  ///< 1: has a normal inequality; has friction bounds; else 0
  ArrayXd w_n, w_t, c_n, c_t, b_n, b_t, geometric_;  ///< responses, compliances, offsets, sqrt(w_n w_t)
  PathPoint at_;
  ArrayXd u_, v_, F_, rate_;  ///< rates with offsets and compliance, friction bounds and their rates
  ArrayXd D_n, D_t, coupling_;
  std::vector<ContactStiffness> stiffness_;
};

InteriorPath::InteriorPath(ContactProblem& problem, ContactMatrix& matrix)
    : problem_(problem), matrix_(matrix), n_(problem.n_contacts()), stiffness_(index(n_)) {
  for (ArrayXd* a : {&bounded_, &rubbing_, &w_n, &w_t, &c_n, &c_t, &b_n, &b_t, &F_, &rate_, &D_n, &D_t})
    a->setZero(n_);
  for (int c = 0; c < n_; ++c) {
    const CoulombLaw& law = problem.law(c);
    bounded_[c] = law.bonded ? 0 : 1;
    rubbing_[c] = !law.bonded && law.has_friction() ? 1 : 0;
    w_n[c] = problem.response(c).normal;
    w_t[c] = problem.response(c).shear;
    c_n[c] = law.normal_compliance;
    c_t[c] = law.shear_compliance;
    b_n[c] = problem.offsets[index(c)].normal;
    b_t[c] = problem.offsets[index(c)].shear;
  }
  geometric_ = ((w_n + c_n) * (w_t + c_t)).sqrt();
  at_.z = problem.free_velocity();
  VectorXd u, v;
  contact_rates(problem, at_.z, u, v);
  u_ = u.array() + b_n;
  v_ = v.array() + b_t;
  // The velocity that impulses have to undo.
  double scale = std::sqrt((-u_).max(0).square().mean());
  if (scale == 0) scale = std::sqrt((u_.square() + v_.square()).mean());
  if (scale == 0) scale = 1;
  at_.y = u_.max(0) + scale;
  at_.p = bounded_ * (scale / (w_n + c_n)) * (scale / at_.y).max(0.3);
  at_.q = ArrayXd::Zero(n_);
  at_.a_plus.resize(n_);
  for (int c = 0; c < n_; ++c) at_.a_plus[c] = std::max(problem.law(c).bound(at_.p[c]), 1e-8 * at_.p[c]);
  at_.a_minus = at_.a_plus;
  at_.l_plus = (-v_).max(0) + scale;
  at_.l_minus = v_.max(0) + scale;
}

void InteriorPath::evaluate() {
  VectorXd u, v;
  contact_rates(problem_, at_.z, u, v);
  u_ = u.array() + b_n + c_n * at_.p;
  v_ = v.array() + b_t + c_t * at_.q;
  for (int c = 0; c < n_; ++c) {
    F_[c] = problem_.law(c).bound(at_.p[c]);
    rate_[c] = problem_.law(c).bound_rate(at_.p[c]);
    if (bounded_[c] == 0) {
      D_n[c] = 1 / (c_n[c] + w_n[c] / kappa);
      D_t[c] = 1 / (c_t[c] + w_t[c] / kappa);
    } else {
      D_n[c] = at_.p[c] / (at_.y[c] + c_n[c] * at_.p[c]);
      D_t[c] = rubbing_[c] == 0
                   ? 0
                   : 1 / (at_.l_plus[c] / at_.a_plus[c] + at_.l_minus[c] / at_.a_minus[c] + c_t[c]);
    }
  }
  coupling_ = rubbing_ * rate_ * (at_.l_plus / at_.a_plus - at_.l_minus / at_.a_minus) * D_t;
  for (int c = 0; c < n_; ++c) stiffness_[index(c)] = {D_n[c], D_t[c], coupling_[c] * D_n[c]};
}

PathPoint InteriorPath::direction(const Targets& t) {
  const ArrayXd r_y = bounded_ * (u_ - at_.y), r_plus = F_ - at_.q - at_.a_plus,
                r_minus = F_ + at_.q - at_.a_minus;
  // dp = dp_0 - D_n H_n dz,  dq = dq_0 - D_t H_t dz + coupling dp.
  const ArrayXd dp_0 =
      bounded_ * (t.normal - at_.p * at_.y - at_.p * r_y) / (at_.y + c_n * at_.p) - (1 - bounded_) * D_n * u_;
  const ArrayXd pull = rubbing_ * ((t.plus - at_.l_plus * r_plus) / at_.a_plus -
                                   (t.minus - at_.l_minus * r_minus) / at_.a_minus);
  const ArrayXd dq_0 = -D_t * (v_ + pull);
  VectorXd right = mass_times(problem_, problem_.free_velocity() - at_.z);
  add_impulses(problem_, at_.p + dp_0, at_.q + dq_0 + coupling_ * dp_0, right);
  PathPoint d;
  d.z = matrix_.solve(right);
  VectorXd u, v;
  contact_rates(problem_, d.z, u, v);
  d.p = dp_0 - D_n * u.array();
  d.q = dq_0 - D_t * v.array() + coupling_ * d.p;
  d.y = bounded_ * (u.array() + c_n * d.p + r_y);
  d.a_plus = rubbing_ * (rate_ * d.p - d.q + r_plus);
  d.a_minus = rubbing_ * (rate_ * d.p + d.q + r_minus);
  d.l_plus = rubbing_ * (t.plus - at_.l_plus * at_.a_plus - at_.l_plus * d.a_plus) / at_.a_plus;
  d.l_minus = rubbing_ * (t.minus - at_.l_minus * at_.a_minus - at_.l_minus * d.a_minus) / at_.a_minus;
  return d;
}

double InteriorPath::longest_step(const PathPoint& d) const {
  double length = 1 / 0.99;
  const auto limit = [&](const ArrayXd& mask, const ArrayXd& x, const ArrayXd& dx) {
    for (int c = 0; c < n_; ++c)
      if (mask[c] != 0 && dx[c] < 0) length = std::min(length, -x[c] / dx[c]);
  };
  limit(bounded_, at_.p, d.p);
  limit(bounded_, at_.y, d.y);
  limit(rubbing_, at_.a_plus, d.a_plus);
  limit(rubbing_, at_.a_minus, d.a_minus);
  limit(rubbing_, at_.l_plus, d.l_plus);
  limit(rubbing_, at_.l_minus, d.l_minus);
  return 0.99 * length;  // not onto the boundary
}

/// The mean of the products, as velocities squared.
double InteriorPath::complementarity(const PathPoint& x) const {
  const double sum = (bounded_ * x.p * x.y * (w_n + c_n)).sum() +
                     (rubbing_ * (x.l_plus * x.a_plus + x.l_minus * x.a_minus) * geometric_).sum();
  return sum / std::max(1.0, bounded_.sum() + 2 * rubbing_.sum());
}

PathPoint InteriorPath::moved(const PathPoint& d, double length) const {
  return {at_.z + length * d.z,           at_.p + length * d.p,
          at_.q + length * d.q,           at_.y + length * d.y,
          at_.a_plus + length * d.a_plus, at_.a_minus + length * d.a_minus,
          at_.l_plus + length * d.l_plus, at_.l_minus + length * d.l_minus};
}

bool InteriorPath::advance(ContactSolverCounts& counts) {
  evaluate();
  ++counts.factorizations;
  ++counts.interior_point_iterations;
  if (!matrix_.factorize(stiffness_)) return false;
  const double mu = complementarity(at_);
  const ArrayXd zero = ArrayXd::Zero(n_);
  const PathPoint predictor = direction({zero, zero, zero});
  double length = longest_step(predictor);
  // Mehrotra's heuristic: centre as little as the predictor got through, at least .5 where it did not.
  const double ratio = complementarity(moved(predictor, length)) / mu;
  const double centring = length > 0.1 ? std::clamp(ratio * ratio, 1e-4, 1.0) : 0.5;
  const double second_order = length > 0.3 ? 1 : 0, goal = centring * mu;
  PathPoint d = direction({goal / (w_n + c_n) - second_order * predictor.p * predictor.y,
                           goal / geometric_ - second_order * predictor.l_plus * predictor.a_plus,
                           goal / geometric_ - second_order * predictor.l_minus * predictor.a_minus});
  length = longest_step(d);
  if (length < 0.05) {  // back towards the path
    d = direction({0.8 * mu / (w_n + c_n), 0.8 * mu / geometric_, 0.8 * mu / geometric_});
    length = longest_step(d);
  }
  if (!(length > 1e-8) || !d.z.allFinite()) return false;
  at_ = moved(d, length);
  return true;
}

void InteriorPath::store_impulses() {
  for (int c = 0; c < n_; ++c) problem_.impulses[index(c)] = problem_.law(c).project({at_.p[c], at_.q[c]});
}

}  // namespace

ContactResidual interior_point(ContactProblem& problem, ContactMatrix& matrix, double required,
                               ContactSolverCounts& counts) {
  ++counts.interior_point_solves;
  InteriorPath path(problem, matrix);
  path.store_impulses();
  std::vector<NormalAndShear> best = problem.impulses;
  ContactResidual least = residual(problem, problem.velocity());
  for (int i = 0; i < max_iterations && least.relative > required; ++i) {
    if (!path.advance(counts)) break;
    path.store_impulses();
    const ContactResidual left = residual(problem, problem.velocity());
    if (left.relative < least.relative) {
      least = left;
      best = problem.impulses;
    }
  }
  problem.impulses = best;
  return least;
}

}  // namespace ddacontact
