#include <ddacontact/time/impulse_problem.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace ddacontact {

namespace {

/// Springs against rates over the largest mass: a round of multipliers leaves the inverse of this of an
/// error, more in long chains.
constexpr double stiffness_factor = 1e4;
constexpr int max_rounds = MinimizeOptions{}.max_iterations;
/// The rates have come down to round-off when as many rounds have not lessened them.
constexpr int max_rounds_without_gain = 10;

std::vector<int> all_rows(int n) {
  std::vector<int> rows(static_cast<std::size_t>(n));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

bool moves(const AffineForm& rate) {
  return std::ranges::any_of(rate.coefficients(), [](double c) { return c != 0; });
}

/// Without what no impulse can change.
std::vector<ContactTerm> effective(std::vector<ContactTerm> terms) {
  for (ContactTerm& term : terms) {
    if (!moves(term.gap)) term.normal = ContactTerm::Normal::absent;
    if (!moves(term.slip)) term.sheared = false;
  }
  return terms;
}

}  // namespace

NormalAndShear rates_of(const std::vector<ContactTerm>& terms, const VectorXd& velocities) {
  NormalAndShear rates(terms.size(), 2);
  for (std::size_t c = 0; c < terms.size(); ++c)
    rates.row(c) << terms[c].gap.change(velocities), terms[c].slip.change(velocities);
  return rates;
}

ImpulseProblem::ImpulseProblem(const RigidMotions& motions, std::vector<ContactTerm> terms)
    : terms_(effective(std::move(terms))), n_(motions.n_coefficients()), problem_(all_rows(n_), n_) {
  for (ContactTerm& term : terms_) {
    term.normal_stiffness = term.tangential_stiffness = stiffness_factor * motions.largest_mass();
    for (const AffineForm* rate : {&term.gap, &term.slip})
      for (double c : rate->coefficients()) steepest_ = std::max(steepest_, std::abs(c));
  }
  polyfem::Connectivity elements;
  for (int k = 0; k < n_; ++k) elements.append({&k, 1});
  problem_.set_matrices(elements);
  for (MatrixXd& element : problem_.elements()) element(0, 0) = 1;
  problem_.matrices_changed();
}

void ImpulseProblem::set_bounds(const VectorXd& bounds) {
  for (std::size_t c = 0; c < terms_.size(); ++c) {
    ContactTerm& term = terms_[c];
    if (std::isinf(term.bound)) continue;
    term.bound = bounds[c];
    term.tangential_multiplier = std::clamp(term.tangential_multiplier, -term.bound, term.bound);
  }
}

NormalAndShear ImpulseProblem::impulses() const {
  NormalAndShear impulses(terms_.size(), 2);
  for (std::size_t c = 0; c < terms_.size(); ++c)
    impulses.row(c) << terms_[c].normal_multiplier, terms_[c].tangential_multiplier;
  return impulses;
}

void ImpulseProblem::forget_impulses() {
  for (ContactTerm& term : terms_) term.normal_multiplier = term.tangential_multiplier = 0;
}

VectorXd ImpulseProblem::change(const NormalAndShear& impulses) const {
  VectorXd w = VectorXd::Zero(n_);
  for (std::size_t c = 0; c < terms_.size(); ++c) {
    terms_[c].gap.add_gradient(impulses(c, of_gap), w);
    terms_[c].slip.add_gradient(impulses(c, of_slip), w);
  }
  return w;
}

void ImpulseProblem::set_rates(const NormalAndShear& rates, const VectorXd& w) {
  for (std::size_t c = 0; c < terms_.size(); ++c) {
    terms_[c].gap.constant = rates(c, of_gap) + terms_[c].gap.change(w);
    terms_[c].slip.constant = rates(c, of_slip) + terms_[c].slip.change(w);
  }
}

double ImpulseProblem::largest_rate() const {
  double largest = 0;
  for (const ContactTerm& term : terms_) {
    if (term.normal == ContactTerm::Normal::absent) continue;
    const bool is_closed = term.normal == ContactTerm::Normal::bilateral || term.normal_multiplier > 0;
    largest = std::max(largest, is_closed ? std::abs(term.gap.constant) : -term.gap.constant);
    if (term.sheared && std::abs(term.tangential_multiplier) < term.bound)
      largest = std::max(largest, std::abs(term.slip.constant));
  }
  return largest;
}

bool ImpulseProblem::solve(const NormalAndShear& rates, double tolerance) {
  assert(rates.rows() == std::ssize(terms_) && tolerance > 0);
  const MinimizeOptions options{.tolerance = 0.1 * tolerance / steepest_};
  VectorXd w = change(impulses()), d;
  set_rates(rates, w);
  double least = inf;
  for (int rounds_without_gain = 0, round = 0; round < max_rounds; ++round) {
    d.setZero(n_);
    if (problem_.minimize(terms_, w, options, d).status != MinimizeStatus::converged) return false;
    for (ContactTerm& term : terms_) {
      const ContactForce impulse = contact_force(term, d);
      term.normal_multiplier = impulse.normal;
      term.tangential_multiplier = impulse.shear;
    }
    w = change(impulses());
    set_rates(rates, w);
    const double largest = largest_rate();
    if (largest <= tolerance) return true;
    rounds_without_gain = largest < least ? 0 : rounds_without_gain + 1;
    if (rounds_without_gain == max_rounds_without_gain) return false;
    least = std::min(least, largest);
  }
  return false;
}

}  // namespace ddacontact
