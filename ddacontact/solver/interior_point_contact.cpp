#include <ddacontact/solver/contact_operators.hpp>
#include <ddacontact/solver/interior_point_contact.hpp>

#include <limits>

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

/// The mean impulse of the contacts of each contact's bodies, of the body with the smaller one.
std::vector<double> impulse_scales(const ContactProblem& problem) {
  const std::vector<double> sums = impulse_sums(problem);
  std::vector<int> n_contacts(sums.size(), 0);
  for (int c = 0; c < problem.n_contacts(); ++c)
    for (const int side : {0, 1})
      if (const int b = problem.body(c, side); b >= 0) ++n_contacts[index(b)];
  std::vector<double> scale(index(problem.n_contacts()), std::numeric_limits<double>::infinity());
  for (int c = 0; c < problem.n_contacts(); ++c)
    for (const int side : {0, 1})
      if (const int b = problem.body(c, side); b >= 0)
        scale[index(c)] = std::min(scale[index(c)], sums[index(b)] / n_contacts[index(b)]);
  return scale;
}

class InteriorPath {
 public:
  InteriorPath(ContactProblem& problem, ContactMatrix& matrix);

  /// One predictor and corrector. \return false where there is no way on
  [[nodiscard]] bool advance(ContactSolverCounts& counts);
  /// Impulses that obey the bounds.
  void store_impulses();
  /// Newton's full step towards mu = 0: how large impulses are going to be.
  [[nodiscard]] bool predict(ContactSolverCounts& counts);

 private:
  void place(int c, double scale, double u, double v);
  void evaluate();
  PathPoint direction(const Targets& targets);
  double longest_step(const PathPoint& d) const;
  double complementarity(const PathPoint& at) const;
  PathPoint moved(const PathPoint& d, double length) const;

  ContactProblem& problem_;
  ContactMatrix& matrix_;
  int n_;
  ArrayXd bounded_, rubbing_;  ///< 1: has a normal inequality; has friction bounds; else 0
  ArrayXd w_n, w_t, c_n, c_t, b_n, b_t, e_n, e_t;  ///< responses, compliances, offsets, scales of products
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
  at_.z = problem.velocity();
  VectorXd u, v;
  contact_rates(problem, at_.z, u, v);
  for (ArrayXd* a :
       {&at_.p, &at_.q, &at_.y, &at_.a_plus, &at_.a_minus, &at_.l_plus, &at_.l_minus, &e_n, &e_t})
    a->setOnes(n_);
  const std::vector<double> scale = impulse_scales(problem);
  for (int c = 0; c < n_; ++c) place(c, scale[index(c)], u[c] + b_n[c], v[c] + b_t[c]);
}

/// Puts a contact inside its law, near its impulses and rates, with products of theta^2.
void InteriorPath::place(int c, double scale, double u, double v) {
  constexpr double theta = 3;  // of the scale: large, since impulses may have to grow far
  constexpr double share = 0.9,
                   least_bound = 1e-8;  // of the bound, that q starts with; of p, that a bound has
  const CoulombLaw& law = problem_.law(c);
  const NormalAndShear start = problem_.impulses[index(c)];
  const double w = w_n[c] + c_n[c];
  const double s = std::max(scale, 1e-3 * std::abs(u) / w);  // where impulses say nothing
  e_n[c] = w * s * s;
  e_t[c] = std::sqrt(w * (w_t[c] + c_t[c])) * s * s;
  if (!(s > 0)) e_n[c] = e_t[c] = 1;
  u += c_n[c] * start.normal;
  v += c_t[c] * start.shear;
  if (law.bonded) {
    at_.p[c] = start.normal;
    at_.q[c] = start.shear;
    return;
  }
  const double product = theta * theta * e_n[c], product_t = theta * theta * e_t[c];
  const double p = std::max(start.normal, product / std::max(u, std::sqrt(product * w)));
  const double F = std::max(law.bound(p), least_bound * p),
               q = std::clamp(start.shear, -share * F, share * F);
  at_.p[c] = p;
  at_.q[c] = rubbing_[c] * q;
  at_.y[c] = std::max(u, product / p);
  at_.a_plus[c] = F - q;
  at_.a_minus[c] = F + q;
  at_.l_plus[c] = std::max(-v, product_t / at_.a_plus[c]);
  at_.l_minus[c] = std::max(v, product_t / at_.a_minus[c]);
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
  constexpr double inside = 0.99;  // not onto the boundary
  double length = 1 / inside;
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
  return inside * length;
}

/// The mean of the products, each over its scale.
double InteriorPath::complementarity(const PathPoint& x) const {
  const double sum = (bounded_ * x.p * x.y / e_n).sum() +
                     (rubbing_ * (x.l_plus * x.a_plus + x.l_minus * x.a_minus) / e_t).sum();
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
  PathPoint d = direction({goal * e_n - second_order * predictor.p * predictor.y,
                           goal * e_t - second_order * predictor.l_plus * predictor.a_plus,
                           goal * e_t - second_order * predictor.l_minus * predictor.a_minus});
  length = longest_step(d);
  if (length < 0.05) {  // back towards the path
    const double back = 0.8 * mu;
    d = direction({back * e_n, back * e_t, back * e_t});
    length = longest_step(d);
  }
  if (!(length > 1e-8) || !d.z.allFinite()) return false;
  at_ = moved(d, length);
  return true;
}

bool InteriorPath::predict(ContactSolverCounts& counts) {
  evaluate();
  ++counts.factorizations;
  if (!matrix_.factorize(stiffness_)) return false;
  const ArrayXd zero = ArrayXd::Zero(n_);
  at_ = moved(direction({zero, zero, zero}), 1);
  return at_.z.allFinite();
}

void InteriorPath::store_impulses() {
  for (int c = 0; c < n_; ++c) problem_.impulses[index(c)] = problem_.law(c).project({at_.p[c], at_.q[c]});
}

}  // namespace

ContactResidual interior_point(ContactProblem& problem, ContactMatrix& matrix, double required,
                               ContactSolverCounts& counts) {
  ++counts.interior_point_solves;
  std::vector<NormalAndShear> best = problem.impulses;
  ContactResidual least = residual(problem, problem.velocity());
  constexpr int n_predictions = 2;
  for (int i = 0; i < n_predictions; ++i) {
    InteriorPath path(problem, matrix);
    if (!path.predict(counts)) break;
    path.store_impulses();
  }
  InteriorPath path(problem, matrix);
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
