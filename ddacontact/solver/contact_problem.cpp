#include <ddacontact/solver/contact_problem.hpp>

#include <Eigen/Cholesky>

#include <cassert>
#include <limits>
#include <utility>

namespace ddacontact {

namespace {

double dot(std::span<const double> row, const double* x) {
  double sum = 0;
  for (std::size_t i = 0; i < row.size(); ++i) sum += row[i] * x[i];
  return sum;
}

double magnitude(std::span<const double> row, const double* x) {
  double sum = 0;
  for (std::size_t i = 0; i < row.size(); ++i) sum += std::abs(row[i] * x[i]);
  return sum;
}

}  // namespace

void ContactProblem::append_body(const VectorXd& mass, MatrixXd dense, MatrixXd inverse,
                                 const Eigen::Ref<const VectorXd>& free_velocity) {
  assert(mass.size() == free_velocity.size());
  diagonal_.insert(diagonal_.end(), mass.data(), mass.data() + mass.size());
  dense_.push_back(std::move(dense));
  inverse_.push_back(std::move(inverse));
  const Index n = free_velocity_.size();
  free_velocity_.conservativeResize(n + free_velocity.size());
  free_velocity_.tail(free_velocity.size()) = free_velocity;
  first_.push_back(static_cast<int>(free_velocity_.size()));
  body_scale.push_back(0);
}

int ContactProblem::add_diagonal_body(const VectorXd& mass, const Eigen::Ref<const VectorXd>& free_velocity) {
  assert((mass.array() > 0).all());
  append_body(mass, {}, {}, free_velocity);
  return n_bodies() - 1;
}

int ContactProblem::add_dense_body(const MatrixXd& mass, const Eigen::Ref<const VectorXd>& free_velocity) {
  const Index n = mass.rows();
  append_body(mass.diagonal(), mass, mass.llt().solve(MatrixXd::Identity(n, n)), free_velocity);
  return n_bodies() - 1;
}

void ContactProblem::append_side(const Side& side) {
  if (side.body < 0) return;
  const int n = count(side.body);
  assert(side.normal.size() == n && side.shear.size() == n);
  VectorXd response[2] = {VectorXd::Zero(n), VectorXd::Zero(n)};
  add_response(side.body, side.normal.data(), 1, response[0].data());
  add_response(side.body, side.shear.data(), 1, response[1].data());
  for (const double* row : {side.normal.data(), side.shear.data(), std::as_const(response[0]).data(),
                            std::as_const(response[1]).data()})
    coefficients_.insert(coefficients_.end(), row, row + n);
}

int ContactProblem::add_contact(const Side& one, const Side& other, const NormalAndShear& offset,
                                const CoulombLaw& law) {
  assert(one.body != other.body && one.body < n_bodies() && other.body < n_bodies());
  contacts_.push_back({{one.body, other.body}, coefficients_.size(), law});
  append_side(one);
  append_side(other);
  const int contact = n_contacts() - 1;
  NormalAndShear response;
  double cross_response = 0;
  for (const int side : {0, 1}) {
    const auto normal = normal_response(contact, side);
    response.normal += dot(normal_row(contact, side), normal.data());
    response.shear += dot(shear_row(contact, side), shear_response(contact, side).data());
    cross_response += dot(shear_row(contact, side), normal.data());
  }
  // A direction that nothing moves in is given this part of the other's response: more than round-off leaves.
  constexpr double least = 1e-12;
  const double largest = std::max(response.normal, response.shear);
  const double floor = largest > 0 ? least * largest : 1;
  response_.push_back({std::max(response.normal, floor), std::max(response.shear, floor)});
  cross_response_.push_back(cross_response);
  offsets.push_back(offset);
  impulses.push_back({});
  return contact;
}

std::span<const double> ContactProblem::row(int contact, int side, int which) const {
  const Contact& c = contacts_[index(contact)];
  const int body = c.body[side];
  if (body < 0) return {};
  const std::size_t n = index(count(body)),
                    before = side == 1 && c.body[0] >= 0 ? 4 * index(count(c.body[0])) : 0;
  return {coefficients_.data() + c.first_coefficient + before + index(which) * n, n};
}

std::span<const double> ContactProblem::diagonal(int body) const {
  assert(is_diagonal(body));
  return {diagonal_.data() + first(body), index(count(body))};
}

void ContactProblem::add_mass_times(int body, const double* x, double factor, double* y) const {
  const Index n = count(body);
  const Eigen::Map<const VectorXd> from(x, n);
  Eigen::Map<VectorXd> to(y, n);
  if (is_diagonal(body))
    to += factor * Eigen::Map<const VectorXd>(diagonal_.data() + first(body), n).cwiseProduct(from);
  else
    to += factor * (dense_[index(body)] * from);
}

void ContactProblem::add_response(int body, const double* x, double factor, double* y) const {
  const Index n = count(body);
  const Eigen::Map<const VectorXd> from(x, n);
  Eigen::Map<VectorXd> to(y, n);
  if (is_diagonal(body))
    to += factor * from.cwiseQuotient(Eigen::Map<const VectorXd>(diagonal_.data() + first(body), n));
  else
    to += factor * (inverse_[index(body)] * from);
}

VectorXd ContactProblem::velocity() const {
  VectorXd z = free_velocity_;
  for (int c = 0; c < n_contacts(); ++c) {
    const auto [p, q] = impulses[index(c)];
    if (p == 0 && q == 0) continue;
    for (const int side : {0, 1}) {
      const auto normal = normal_response(c, side), shear = shear_response(c, side);
      if (normal.empty()) continue;
      double* const to = z.data() + first(body(c, side));
      for (std::size_t i = 0; i < normal.size(); ++i) to[i] += normal[i] * p + shear[i] * q;
    }
  }
  return z;
}

NormalAndShear ContactProblem::rates(int contact, const VectorXd& z) const {
  NormalAndShear rate = offsets[index(contact)];
  for (const int side : {0, 1}) {
    const int b = body(contact, side);
    if (b < 0) continue;
    rate.normal += dot(normal_row(contact, side), z.data() + first(b));
    rate.shear += dot(shear_row(contact, side), z.data() + first(b));
  }
  return rate;
}

ContactProblem ContactProblem::part(std::span<const int> bodies, std::span<const int> contacts) const {
  ContactProblem result;
  std::vector<int> number(index(n_bodies()), -1);
  for (const int body : bodies) {
    const std::size_t b = index(body);
    number[b] = result.n_bodies();
    const Index n = count(body);
    result.append_body(Eigen::Map<const VectorXd>(diagonal_.data() + first(body), n), dense_[b], inverse_[b],
                       free_velocity_.segment(first(body), n));
    result.body_scale.back() = body_scale[b];
  }
  for (const int contact : contacts) {
    const Contact& c = contacts_[index(contact)];
    Contact copy = c;
    copy.first_coefficient = result.coefficients_.size();
    std::size_t n_coefficients = 0;
    for (int& body : copy.body) {
      if (body < 0) continue;
      n_coefficients += 4 * index(count(body));
      body = number[index(body)];
    }
    const double* const from = coefficients_.data() + c.first_coefficient;
    result.coefficients_.insert(result.coefficients_.end(), from, from + n_coefficients);
    result.contacts_.push_back(copy);
    result.response_.push_back(response(contact));
    result.cross_response_.push_back(cross_response(contact));
    result.offsets.push_back(offsets[index(contact)]);
    result.impulses.push_back(impulses[index(contact)]);
  }
  return result;
}

std::vector<double> impulse_sums(const ContactProblem& problem) {
  std::vector<double> sums = problem.body_scale;
  for (int c = 0; c < problem.n_contacts(); ++c) {
    const auto [p, q] = problem.impulses[static_cast<std::size_t>(c)];
    for (const int side : {0, 1})
      if (const int body = problem.body(c, side); body >= 0)
        sums[static_cast<std::size_t>(body)] += std::abs(p) + std::abs(q);
  }
  return sums;
}

double impulse_sum(const ContactProblem& problem, const std::vector<double>& sums, int contact) {
  double sum = std::numeric_limits<double>::infinity();
  for (const int side : {0, 1})
    if (const int body = problem.body(contact, side); body >= 0)
      sum = std::min(sum, sums[static_cast<std::size_t>(body)]);
  return sum;
}

double residual(const ContactProblem& problem, const VectorXd& z, const std::vector<double>& sums,
                int contact) {
  constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();  // of sums of some ten terms
  const std::size_t c = static_cast<std::size_t>(contact);
  const CoulombLaw& law = problem.law(contact);
  const NormalAndShear& w = problem.response(contact);
  const NormalAndShear left = law.residual(problem.impulses[c], problem.rates(contact, z), w);
  double u = std::abs(problem.offsets[c].normal), v = std::abs(problem.offsets[c].shear);
  for (const int side : {0, 1}) {
    const int body = problem.body(contact, side);
    if (body < 0) continue;
    u += magnitude(problem.normal_row(contact, side), z.data() + problem.first(body));
    v += magnitude(problem.shear_row(contact, side), z.data() + problem.first(body));
  }
  const double normal = std::abs(left.normal) - round_off * u / (w.normal + law.normal_compliance),
               shear = std::abs(left.shear) - round_off * v / (w.shear + law.shear_compliance);
  if (normal <= 0 && shear <= 0) return 0;
  if (!std::isfinite(normal) || !std::isfinite(shear)) return std::numeric_limits<double>::infinity();
  return std::max(normal, shear) / impulse_sum(problem, sums, contact);
}

ContactResidual residual(const ContactProblem& problem, const VectorXd& z) {
  const std::vector<double> sums = impulse_sums(problem);
  ContactResidual worst;
  for (int c = 0; c < problem.n_contacts(); ++c)
    if (const double r = residual(problem, z, sums, c); r > worst.relative) worst = {r, c};
  return worst;
}

}  // namespace ddacontact
