#include <ddacontact/solver/friction_problem.hpp>

#include <ddacontact/solver/small_product.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace ddacontact {

namespace {

/// What quadratic piece d is in.
unsigned char piece(const ContactTerm& contact, const VectorXd& d) {
  const ClippedSpring shear = tangential_spring(contact, d);
  const unsigned char acting = active_springs(contact, d);
  if (shear.low == shear.high || (acting & shear_acts)) return acting;
  return acting | (shear.force > shear.high ? at_upper : at_lower);
}

void find_pieces(const std::vector<ContactTerm>& contacts, const VectorXd& d,
                 std::vector<unsigned char>& pieces) {
  pieces.resize(contacts.size());
  std::ranges::transform(contacts, pieces.begin(), [&](const ContactTerm& of) { return piece(of, d); });
}

/// |multiplier| + stiffness * (sum of the magnitudes of the form's terms): what its force is the sum of.
double magnitude(const AffineForm& form, double stiffness, double multiplier, const VectorXd& d) {
  double sum = std::abs(form.constant);
  form.for_terms([&](int u, double c) { sum += std::abs(c * d[u]); });
  return std::abs(multiplier) + stiffness * sum;
}

void add_magnitude(const AffineForm& form, double force, VectorXd& sums) {
  form.for_terms([&](int u, double c) { sums[u] += std::abs(c) * force; });
}

/// Of more equations than these nested dissection leaves fewer entries than minimum degree.
constexpr int many_equations = 20000;
/// A residual of so many ulps of what it is the sum of is round-off.
constexpr double round_off = 32 * std::numeric_limits<double>::epsilon();

}  // namespace

FrictionProblem::FrictionProblem(std::vector<int> equation, int n_equations)
    : equation_(std::move(equation)), n_equations_(n_equations) {}

void FrictionProblem::set_matrices(polyfem::Connectivity unknowns) {
  elements_ = std::move(unknowns);
  elements_.first.shrink_to_fit();
  elements_.rows.shrink_to_fit();
  matrices_.resize(elements_.n_elements());
  for_elements([&](int e, std::span<const int> u) {
    const Index n = static_cast<Index>(u.size());
    matrices_[e].resize(n, n);
  });
  contacts_changed();
}

void FrictionProblem::contacts_changed() {
  has_pattern_ = false;
  matrices_changed();
}

void FrictionProblem::set_pattern(const std::vector<ContactTerm>& contacts) {
  polyfem::Connectivity connectivity;
  std::vector<int> rows;
  const auto append = [&](std::span<const int> unknowns) {
    rows.clear();
    for (int u : unknowns) rows.push_back(equation_[u]);
    connectivity.append(rows);
  };
  for_elements([&](int, std::span<const int> unknowns) { append(unknowns); });
  for (const ContactTerm& contact : contacts) {
    assert(!contact.sheared || std::ranges::equal(contact.gap.unknowns(), contact.slip.unknowns()));
    append(contact.gap.unknowns());
  }
  // Steps go on from what a record holds, which says nothing of orders.
  if (matrix_.set_connectivity(n_equations_, connectivity) || is_dissected_ || !cholesky_.is_analyzed()) {
    cholesky_.analyze(matrix_.lower());
    is_dissected_ = false;
  }
  has_pattern_ = true;
}

void FrictionProblem::order_for_many(const std::vector<ContactTerm>& contacts) {
  if (n_equations_ < many_equations) return;
  if (!has_pattern_) set_pattern(contacts);
  if (is_dissected_) return;
  contacts_changed();
  cholesky_.dissect(matrix_.lower());
  is_dissected_ = has_pattern_ = true;
}

bool FrictionProblem::factorize(const std::vector<ContactTerm>& contacts,
                                const std::vector<unsigned char>& active,
                                const std::vector<Coupling>& couplings) {
  assert(active.size() == contacts.size());
  const auto factorize_matrix = [&] {
    return couplings.empty() ? cholesky_.factorize(matrix_.lower())
                             : cholesky_.factorize(matrix_.lower(), matrix_.more_above());
  };
  if (factored_springs_ == active && factored_couplings_ == couplings)
    return keeps_factor_ || factorize_matrix();
  factored_springs_.reset();
  if (!has_pattern_) set_pattern(contacts);
  matrix_.set_zero();
  const int n_elements = elements_.n_elements();
  for (int e = 0; e < n_elements; ++e) matrix_.add(e, matrices_[e]);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const int e = n_elements + static_cast<int>(c);
    const ContactTerm& contact = contacts[c];
    if (active[c] & normal_acts)  // (39)
      matrix_.add_outer(e, contact.normal_stiffness, contact.gap.coefficients());
    if (active[c] & shear_acts)  // (47)
      matrix_.add_outer(e, contact.tangential_stiffness, contact.slip.coefficients());
  }
  for (const Coupling& coupling : couplings)
    matrix_.add_outer(n_elements + static_cast<int>(coupling.contact), coupling.rate,
                      contacts[coupling.contact].slip.coefficients(),
                      contacts[coupling.contact].gap.coefficients());
  if (!factorize_matrix()) return false;
  if (keeps_factor_) matrix_.forget_above();
  factored_springs_ = active;
  factored_couplings_ = couplings;
  return true;
}

void FrictionProblem::solve(const VectorXd& residual, VectorXd& correction) {
  assert(residual.size() == std::ssize(equation_));
  rhs_.resize(n_equations_);
  for (Index k = 0; k < residual.size(); ++k)
    if (equation_[k] >= 0) rhs_[equation_[k]] = residual[k];
  cholesky_.solve(rhs_, solution_);
  correction.resize(equation_.size());
  for (Index k = 0; k < correction.size(); ++k)
    correction[k] = equation_[k] >= 0 ? solution_[equation_[k]] : 0;
}

VectorXd FrictionProblem::free_part(const VectorXd& b) const {
  VectorXd part = b;
  for (std::size_t u = 0; u < equation_.size(); ++u)
    if (equation_[u] < 0) part[u] = 0;
  return part;
}

void FrictionProblem::compute_residual(const std::vector<ContactTerm>& contacts, const VectorXd& g0,
                                       const VectorXd& d, VectorXd& residual) const {
  residual = g0;
  for_elements([&](int e, std::span<const int> u) { add_product(matrices_[e], u, d, residual); });
  for (const ContactTerm& contact : contacts) {
    const ContactForce force = contact_force(contact, d);
    if (force.normal != 0) contact.gap.add_gradient(-force.normal, residual);
    if (force.shear != 0) contact.slip.add_gradient(-force.shear, residual);
  }
}

/// Whether every entry of residual_ is no more than the round-off of its sum at d.
bool FrictionProblem::is_round_off(const std::vector<ContactTerm>& contacts, const VectorXd& g0,
                                   const VectorXd& d) {
  magnitudes_ = g0.cwiseAbs();
  for_elements([&](int e, std::span<const int> u) {
    for (std::size_t l = 0; l < u.size(); ++l)
      for (std::size_t k = 0; k < u.size(); ++k) magnitudes_[u[k]] += std::abs(matrices_[e](k, l) * d[u[l]]);
  });
  for (const ContactTerm& c : contacts) {
    if (c.normal == ContactTerm::Normal::absent) continue;
    add_magnitude(c.gap, magnitude(c.gap, c.normal_stiffness, c.normal_multiplier, d), magnitudes_);
    if (c.sheared && c.bound > 0)
      add_magnitude(c.slip, magnitude(c.slip, c.tangential_stiffness, c.tangential_multiplier, d),
                    magnitudes_);
  }
  for (Index k = 0; k < d.size(); ++k)
    if (equation_[k] >= 0 && std::abs(residual_[k]) > round_off * magnitudes_[k]) return false;
  return true;
}

/// The t at which the potential of d + t step_ is least; residual_ is that at d.
double FrictionProblem::step_length(const std::vector<ContactTerm>& contacts, const VectorXd& d) {
  double slope = step_.dot(residual_);
  VectorXd force = VectorXd::Zero(step_.size());
  for_elements([&](int e, std::span<const int> u) { add_product(matrices_[e], u, step_, force); });
  std::vector<LineSpring> springs;
  const auto add = [&](const ClippedSpring& spring, double rate) {
    if (rate == 0 || (spring.low == 0 && spring.high == 0)) return;
    slope += spring.clipped() * rate;
    springs.push_back({spring, rate});
  };
  for (const ContactTerm& contact : contacts) {
    add(normal_spring(contact, d), contact.gap.change(step_));
    add(tangential_spring(contact, d), contact.slip.change(step_));
  }
  return minimum_along(springs, slope, std::inner_product(step_.begin(), step_.end(), force.begin(), 0.0));
}

MinimizeReport FrictionProblem::minimize(const std::vector<ContactTerm>& contacts, const VectorXd& g0,
                                         const MinimizeOptions& options, VectorXd& d) {
  assert(g0.size() == d.size() && d.size() == std::ssize(equation_));
  MinimizeReport report;
  const auto end = [&](MinimizeStatus status) {
    report.status = status;
    return report;
  };
  const auto measure = [&] {
    compute_residual(contacts, g0, d, residual_);
    const VectorXd left = free_part(residual_);
    report.residual = left.allFinite() ? left.lpNorm<Eigen::Infinity>() : inf;
  };
  measure();
  find_pieces(contacts, d, pieces_);
  bool kept = false;
  for (double before = 0;; before = report.residual) {
    if (!std::isfinite(report.residual)) return end(MinimizeStatus::not_finite);
    // The minimum of the piece that d is in is exact but for round-off; solving again repairs what it can of
    // that.
    if (report.residual <= options.tolerance || (kept && report.residual > before / 2) ||
        is_round_off(contacts, g0, d))
      return end(MinimizeStatus::converged);
    if (report.iterations == options.max_iterations) return report;
    active_ = pieces_;
    for (unsigned char& springs : active_) springs &= all_act;
    if (!factorize(contacts, active_)) return end(MinimizeStatus::not_positive_definite);
    solve(-residual_, step_);
    ++report.iterations;
    trial_ = d + step_;
    find_pieces(contacts, trial_, trial_pieces_);
    kept = trial_pieces_ == pieces_;
    if (kept) {
      d = trial_;
    } else {
      d += step_length(contacts, d) * step_;
      find_pieces(contacts, d, pieces_);
    }
    measure();
  }
}

}  // namespace ddacontact
