#include <ddacontact/solver/contact_operators.hpp>

namespace ddacontact {

void contact_rates(const ContactProblem& problem, const VectorXd& z, VectorXd& u, VectorXd& v) {
  u.setZero(problem.n_contacts());
  v.setZero(problem.n_contacts());
  for (int c = 0; c < problem.n_contacts(); ++c)
    for (const int side : {0, 1}) {
      const auto normal = problem.normal_row(c, side), shear = problem.shear_row(c, side);
      if (normal.empty()) continue;
      const double* const x = z.data() + problem.first(problem.body(c, side));
      for (std::size_t i = 0; i < normal.size(); ++i) {
        u[c] += normal[i] * x[i];
        v[c] += shear[i] * x[i];
      }
    }
}

void add_impulses(const ContactProblem& problem, const VectorXd& p, const VectorXd& q, VectorXd& y) {
  for (int c = 0; c < problem.n_contacts(); ++c) {
    if (p[c] == 0 && q[c] == 0) continue;
    for (const int side : {0, 1}) {
      const auto normal = problem.normal_row(c, side), shear = problem.shear_row(c, side);
      if (normal.empty()) continue;
      double* const to = y.data() + problem.first(problem.body(c, side));
      for (std::size_t i = 0; i < normal.size(); ++i) to[i] += normal[i] * p[c] + shear[i] * q[c];
    }
  }
}

VectorXd mass_times(const ContactProblem& problem, const VectorXd& z) {
  VectorXd y = VectorXd::Zero(z.size());
  for (int b = 0; b < problem.n_bodies(); ++b)
    problem.add_mass_times(b, z.data() + problem.first(b), 1, y.data() + problem.first(b));
  return y;
}

}  // namespace ddacontact
