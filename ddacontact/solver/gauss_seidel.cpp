#include <ddacontact/solver/gauss_seidel.hpp>

namespace ddacontact {

namespace {

void apply(const ContactProblem& problem, int contact, const NormalAndShear& change, VectorXd& z) {
  for (const int side : {0, 1}) {
    const auto normal = problem.normal_response(contact, side), shear = problem.shear_response(contact, side);
    if (normal.empty()) continue;
    double* const to = z.data() + problem.first(problem.body(contact, side));
    for (std::size_t i = 0; i < normal.size(); ++i)
      to[i] += normal[i] * change.normal + shear[i] * change.shear;
  }
}

}  // namespace

NormalAndShear solve_contact(const CoulombLaw& law, const NormalAndShear& response, double cross_response,
                             const NormalAndShear& start, const NormalAndShear& rates) {
  const double w_n = response.normal + law.normal_compliance, w_t = response.shear + law.shear_compliance,
               w = cross_response;
  // u = u_0 + w_n p + w q, v = v_0 + w p + w_t q, compliance included.
  const double u_0 = rates.normal - response.normal * start.normal - w * start.shear,
               v_0 = rates.shear - response.shear * start.shear - w * start.normal;
  const double determinant = w_n * w_t - w * w;
  const NormalAndShear stick{(w * v_0 - w_t * u_0) / determinant, (w * u_0 - w_n * v_0) / determinant};
  if (law.bonded) return determinant > 0 ? stick : start;
  if (u_0 >= 0) return {};
  if (!law.has_friction()) return {-u_0 / w_n, 0};
  if (determinant > 0 && stick.normal >= 0 && std::abs(stick.shear) <= law.bound(stick.normal)) return stick;
  // Sliding, q = sign (F_0 + F' p) with a friction law linearized where it was.
  const double rate = law.bound_rate(start.normal), constant = law.bound(start.normal) - rate * start.normal;
  for (const double sign : {1.0, -1.0}) {
    const double w_slip = w_n + sign * rate * w;
    if (w_slip <= 0) continue;
    const double p = -(u_0 + w * sign * constant) / w_slip;
    const double q = sign * law.bound(p);
    if (p >= 0 && (v_0 + w * p + w_t * q) * sign <= 0) return {p, q};
  }
  // What is left: a linearized law that is far off, and round-off. Normal first, then shear.
  const double p = std::max(0.0, -(u_0 + w * start.shear) / w_n), largest = law.bound(p);
  return {p, std::clamp(-(v_0 + w * p) / w_t, -largest, largest)};
}

void sweep(ContactProblem& problem, VectorXd& z, bool forward) {
  const int n = problem.n_contacts();
  for (int k = 0; k < n; ++k) {
    const int c = forward ? k : n - 1 - k;
    NormalAndShear& impulse = problem.impulses[static_cast<std::size_t>(c)];
    const NormalAndShear next = solve_contact(problem.law(c), problem.response(c), problem.cross_response(c),
                                              impulse, problem.rates(c, z));
    const NormalAndShear change{next.normal - impulse.normal, next.shear - impulse.shear};
    if (change.normal == 0 && change.shear == 0) continue;
    impulse = next;
    apply(problem, c, change, z);
  }
}

}  // namespace ddacontact
