#include <ddacontact/solver/augmented_lagrangian.hpp>
#include <ddacontact/solver/contact_newton.hpp>
#include <ddacontact/solver/contact_solution.hpp>
#include <ddacontact/solver/gauss_seidel.hpp>
#include <ddacontact/solver/interior_point_contact.hpp>

#include <algorithm>
#include <numeric>

namespace ddacontact {

namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

struct Island {
  std::vector<int> bodies, contacts;
};

/// Bodies that contacts connect, in the order of their first contacts.
std::vector<Island> islands_of(const ContactProblem& problem) {
  std::vector<int> parent(index(problem.n_bodies()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int body) {
    while (parent[index(body)] != body) body = parent[index(body)] = parent[index(parent[index(body)])];
    return body;
  };
  for (int c = 0; c < problem.n_contacts(); ++c)
    if (problem.body(c, 0) >= 0 && problem.body(c, 1) >= 0)
      parent[index(root(problem.body(c, 0)))] = root(problem.body(c, 1));
  std::vector<int> number(index(problem.n_bodies()), -1);
  std::vector<Island> islands;
  for (int c = 0; c < problem.n_contacts(); ++c) {
    int& island = number[index(root(std::max(problem.body(c, 0), problem.body(c, 1))))];
    if (island < 0) {
      island = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    islands[index(island)].contacts.push_back(c);
  }
  for (int b = 0; b < problem.n_bodies(); ++b)
    if (const int island = number[index(root(b))]; island >= 0) islands[index(island)].bodies.push_back(b);
  return islands;
}

/// Sweeps while they reach `required` soon.
ContactResidual sweep_while_it_pays(ContactProblem& problem, ContactResidual left, double required,
                                    ContactSolverCounts& counts) {
  constexpr int n_sweeps = 8, longest = 200;  // what costs about as much as a Newton iteration or two
  VectorXd z = problem.velocity();
  std::vector<NormalAndShear> best = problem.impulses;
  ContactResidual least = left;
  for (int swept = 0; swept < longest;) {
    for (int i = 0; i < n_sweeps; ++i) sweep(problem, z, i % 2 == 0);
    swept += n_sweeps;
    counts.sweeps += n_sweeps;
    z = problem.velocity();
    const ContactResidual now = residual(problem, z);
    const double rate = std::log(left.relative / now.relative) / n_sweeps;
    left = now;
    if (now.relative < least.relative) {
      least = now;
      best = problem.impulses;
    }
    if (now.relative <= required) break;
    if (!(rate > 0) || std::log(now.relative / required) / rate > longest - swept) break;
  }
  problem.impulses = best;
  return least;
}

ContactResidual solve_island(ContactProblem& problem, const ContactSolverOptions& options,
                             ContactSolverCounts& counts) {
  ContactResidual left = residual(problem, problem.velocity());
  if (left.relative <= options.target) return left;
  // What nearly rests is to come to rest; what moves need not be solved beyond the tolerance.
  constexpr double reduction = 1e-6;
  const double required = std::clamp(left.relative * reduction, options.target, options.tolerance);
  left = sweep_while_it_pays(problem, left, required, counts);
  if (left.relative <= required) return left;

  constexpr int warm_factorizations = 8, further_factorizations = 60, polishing_factorizations = 16;
  constexpr double near = 1e-6;  // residual from which active sets find the way
  ContactMatrix matrix(problem);
  left = newton(problem, matrix, required, options.target, warm_factorizations, counts);
  if (left.relative <= options.tolerance) return left;
  const std::vector<NormalAndShear> before = problem.impulses;
  interior_point(problem, matrix, near, counts);
  augmented_lagrangian(problem, matrix, required, further_factorizations, counts);
  const ContactResidual after =
      newton(problem, matrix, required, options.target, polishing_factorizations, counts);
  if (after.relative <= left.relative) return after;
  problem.impulses = before;
  return left;
}

}  // namespace

ContactSolution solve(ContactProblem& problem, const ContactSolverOptions& options) {
  ContactSolution solution;
  solution.velocity = problem.velocity();
  const std::vector<double> sums = impulse_sums(problem);
  for (const Island& island : islands_of(problem)) {
    bool settled = true;
    for (const int c : island.contacts)
      settled = settled && residual(problem, solution.velocity, sums, c) <= options.target;
    if (settled) continue;
    ContactProblem part = problem.part(island.bodies, island.contacts);
    solve_island(part, options, solution.counts);
    for (std::size_t i = 0; i < island.contacts.size(); ++i)
      problem.impulses[index(island.contacts[i])] = part.impulses[i];
  }
  solution.velocity = problem.velocity();
  solution.residual = residual(problem, solution.velocity);
  solution.solved = solution.residual.relative <= options.tolerance;
  return solution;
}

}  // namespace ddacontact
