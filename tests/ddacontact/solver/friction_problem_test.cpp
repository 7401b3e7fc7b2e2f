#include <ddacontact/solver/friction_problem.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <tuple>

using namespace ddacontact;
using Normal = ContactTerm::Normal;

namespace {

polyfem::Connectivity listed(const std::vector<Range>& ranges) {
  polyfem::Connectivity elements;
  for (const Range& range : ranges) {
    std::vector<int> unknowns(static_cast<std::size_t>(range.count));
    std::iota(unknowns.begin(), unknowns.end(), range.first);
    elements.append(unknowns);
  }
  return elements;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Blocks of six unknowns with random matrices, some unknowns held, and random contacts between pairs of
/// them.
struct RandomProblem {
  std::mt19937 random;
  std::vector<int> equation;
  std::vector<Range> elements;
  std::vector<MatrixXd> matrices;
  std::vector<ContactTerm> contacts;
  VectorXd g0;

  explicit RandomProblem(unsigned seed, double contrast = 1e3) : random(seed) {
    const int n_blocks = integer(2, 20);
    for (int b = 0; b < n_blocks; ++b) {
      elements.push_back({6 * b, 6});
      const MatrixXd a = MatrixXd::NullaryExpr(6, 6, [&] { return uniform(-1, 1); });
      matrices.push_back(power(contrast) * (a * a.transpose() + 0.05 * MatrixXd::Identity(6, 6)));
    }
    int rows = 0;
    for (int k = 0; k < 6 * n_blocks; ++k) equation.push_back(k < 6 || uniform(0, 1) < 0.1 ? -1 : rows++);
    g0 = 100 * vector();
    for (int c = integer(0, 60); c > 0; --c) contacts.push_back(contact(n_blocks, contrast));
  }

  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
  int integer(int low, int high) { return std::uniform_int_distribution(low, high)(random); }
  double power(double contrast) { return std::pow(contrast, uniform(-1, 1)); }
  VectorXd vector() {
    return VectorXd::NullaryExpr(static_cast<Index>(equation.size()), [&] { return uniform(-1, 1); });
  }

  ContactTerm contact(int n_blocks, double contrast) {
    ContactTerm c;
    const int a = integer(0, n_blocks - 1), b = (a + integer(1, n_blocks - 1)) % n_blocks;
    for (int side : {a, b})
      for (int k = 0; k < 6; ++k) {
        c.gap.add(6 * side + k, uniform(-1, 1));
        c.slip.add(6 * side + k, uniform(-1, 1));
      }
    c.gap.constant = uniform(-1, 1);
    c.slip.constant = uniform(-1, 1);
    c.normal_stiffness = power(contrast);
    c.tangential_stiffness = power(contrast);
    constexpr Normal kinds[] = {Normal::unilateral, Normal::unilateral, Normal::bilateral, Normal::absent};
    c.normal = kinds[integer(0, 3)];
    c.sheared = integer(0, 4) > 0;
    const int bound = integer(0, 4);
    c.bound = bound == 0 ? 0 : bound == 1 ? infinity : 10 * uniform(0, 1);
    c.normal_multiplier = c.normal == Normal::bilateral ? uniform(-9, 9) : uniform(0, 9);
    c.tangential_multiplier = uniform(-1, 1) * std::min(c.bound, 9.);
    return c;
  }

  FrictionProblem problem() const {
    const auto n_equations = std::count_if(equation.begin(), equation.end(), [](int e) { return e >= 0; });
    FrictionProblem made(equation, static_cast<int>(n_equations));
    made.set_matrices(listed(elements));
    for (std::size_t e = 0; e < elements.size(); ++e) made.elements()[e] = matrices[e];
    made.matrices_changed();
    return made;
  }
  MinimizeOptions options(int max_iterations = 100) const { return {0, max_iterations}; }

  /// The potential, written out by cases.
  double energy(const VectorXd& d) const {
    double sum = g0.dot(d);
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const VectorXd u = d.segment(elements[e].first, 6);
      sum += u.dot(matrices[e] * u) / 2;
    }
    for (const ContactTerm& c : contacts) {
      if (c.normal == Normal::absent) continue;
      const double N = c.normal_multiplier - c.normal_stiffness * c.gap(d);
      if (N > 0 || c.normal == Normal::bilateral) sum += N * N / (2 * c.normal_stiffness);
      if (!c.sheared) continue;
      const double T = c.tangential_multiplier - c.tangential_stiffness * c.slip(d), size = std::abs(T);
      sum += (size <= c.bound ? T * T / 2 : c.bound * (size - c.bound / 2)) / c.tangential_stiffness;
    }
    return sum;
  }
  /// Of the potential; written out by cases.
  VectorXd gradient(const VectorXd& d) const {
    VectorXd r = g0;
    for (std::size_t e = 0; e < elements.size(); ++e)
      r.segment(elements[e].first, 6) += matrices[e] * d.segment(elements[e].first, 6);
    for (const ContactTerm& c : contacts) {
      if (c.normal == Normal::absent) continue;
      double N = c.normal_multiplier - c.normal_stiffness * c.gap(d);
      if (c.normal == Normal::unilateral) N = std::max(N, 0.);
      c.gap.add_gradient(-N, r);
      const double T = c.tangential_multiplier - c.tangential_stiffness * c.slip(d);
      if (c.sheared) c.slip.add_gradient(-std::min(std::max(T, -c.bound), c.bound), r);
    }
    return on_free(r);
  }
  /// Of the gradient at d: forces are up to 1e3 times d.
  double round_off(const VectorXd& d) const { return 1e-11 * (1e3 * d.lpNorm<Eigen::Infinity>() + 100); }
  VectorXd on_free(VectorXd r) const {
    for (Index k = 0; k < r.size(); ++k)
      if (equation[k] < 0) r[k] = 0;
    return r;
  }
};

}  // namespace

TEST(FrictionProblem, TheResidualIsTheGradientOfThePotential) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomProblem p(seed, 3);
    const VectorXd d = p.vector();
    VectorXd r;
    p.problem().compute_residual(p.contacts, p.g0, d, r);
    EXPECT_LE((p.on_free(r) - p.gradient(d)).norm(), 1e-12 * r.norm());
    for (Index k = 0; k < d.size(); ++k) {
      const VectorXd h = 1e-6 * VectorXd::Unit(d.size(), k);
      EXPECT_NEAR((p.energy(d + h) - p.energy(d - h)) / 2e-6, r[k], 1e-4) << seed << " unknown " << k;
    }
  }
}

/// Its vanishing is enough: the potential is strictly convex.
TEST(FrictionProblem, FindsTheMinimumInFewIterationsFromAnyStart) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    RandomProblem p(seed);
    FrictionProblem problem = p.problem();
    const VectorXd start = (seed % 2 ? 1e3 : 1) * p.vector();
    VectorXd d = start;
    const MinimizeReport report = problem.minimize(p.contacts, p.g0, p.options(), d);
    EXPECT_EQ(report.status, MinimizeStatus::converged) << seed;
    EXPECT_LE(p.gradient(d).lpNorm<Eigen::Infinity>(), p.round_off(d)) << seed;
    EXPECT_NEAR(p.gradient(d).lpNorm<Eigen::Infinity>(), report.residual, p.round_off(d)) << seed;
    EXPECT_EQ((d - start - p.on_free(d - start)).norm(), 0) << "prescribed degrees of freedom have moved";
    EXPECT_LE(report.iterations, 15) << seed;
    EXPECT_LE(problem.cholesky().n_factorizations(), report.iterations);
  }
}

TEST(FrictionProblem, ThePotentialFallsInEveryIteration) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    RandomProblem p(seed);
    FrictionProblem problem = p.problem();
    const VectorXd start = 100 * p.vector();
    double before = p.energy(start);
    for (int iterations = 1;; ++iterations) {
      VectorXd d = start;
      const MinimizeReport report = problem.minimize(p.contacts, p.g0, p.options(iterations), d);
      EXPECT_LE(p.energy(d), before + 1e-14 * p.energy(start)) << seed << " iteration " << iterations;
      before = p.energy(d);
      if (report.status == MinimizeStatus::converged) break;
      EXPECT_EQ(report.status, MinimizeStatus::iteration_limit);
      EXPECT_EQ(report.iterations, iterations);
    }
  }
}

/// Of one unknown with A = 1 the minimum is known: x - f = N(x) with a wall of stiffness p at 0.
TEST(FrictionProblem, AMassAgainstAWallIsPushedBackByItsSpringAndMultiplier) {
  for (double force : {-3., -1e-9, 0., 2.})
    for (double multiplier : {0., 1., 5.}) {
      ContactTerm wall;
      wall.gap.add(0, 1);
      wall.sheared = false;
      wall.normal_stiffness = 9;
      wall.normal_multiplier = multiplier;
      FrictionProblem problem({0}, 1);
      problem.set_matrices(listed({{0, 1}}));
      problem.elements()[0](0, 0) = 1;
      problem.matrices_changed();
      VectorXd x = VectorXd::Constant(1, 7);
      const VectorXd g0 = VectorXd::Constant(1, -force);
      const MinimizeReport report = problem.minimize({wall}, g0, {}, x);
      EXPECT_EQ(report.status, MinimizeStatus::converged);
      const double closed = (force + multiplier) / 10;
      EXPECT_NEAR(x[0], 9 * closed <= multiplier ? closed : force, 1e-14);
    }
}

TEST(FrictionProblem, NamesWhatActs) {
  ContactTerm c;
  c.gap.add(0, 1);
  c.slip.add(0, 1);
  c.normal_stiffness = c.tangential_stiffness = 2;
  c.bound = 3;
  const auto at = [&](double x) {
    const VectorXd d = VectorXd::Constant(1, x);
    const ContactForce force = contact_force(c, d);
    return std::tuple(static_cast<int>(active_springs(c, d)), force.normal, force.shear);
  };
  EXPECT_EQ(at(-1), std::tuple(3, 2., 2.));
  EXPECT_EQ(at(-2), std::tuple(1, 4., 3.));
  EXPECT_EQ(at(1), std::tuple(2, 0., -2.));
  EXPECT_EQ(at(2), std::tuple(0, 0., -3.));
  c.bound = 0;
  EXPECT_EQ(at(-1), std::tuple(1, 2., 0.));
  c.bound = infinity;
  c.normal = Normal::bilateral;
  EXPECT_EQ(at(9), std::tuple(3, -18., -18.));
  c.sheared = false;
  EXPECT_EQ(at(9), std::tuple(1, -18., 0.));
  c.normal = Normal::absent;
  c.sheared = true;
  EXPECT_EQ(at(-1), std::tuple(0, 0., 0.));
}

TEST(FrictionProblem, FactorizesOnlyWhatHasChanged) {
  RandomProblem p(3);
  ASSERT_FALSE(p.contacts.empty());
  FrictionProblem problem = p.problem();
  std::vector<unsigned char> active(p.contacts.size(), 3);
  const auto factorizations = [&] {
    EXPECT_TRUE(problem.factorize(p.contacts, active));
    return problem.cholesky().n_factorizations();
  };
  EXPECT_EQ(factorizations(), 1);
  EXPECT_EQ(factorizations(), 1);
  active[0] = 1;
  EXPECT_EQ(factorizations(), 2);
  problem.matrices_changed();
  EXPECT_EQ(factorizations(), 3);
  problem.set_matrices(listed(p.elements));
  EXPECT_EQ(factorizations(), 4);
  EXPECT_EQ(problem.cholesky().n_analyses(), 1);
}

TEST(FrictionProblem, FactorizesOnceMoreToTheSameFactorWhenNoneIsKept) {
  RandomProblem p(3);
  FrictionProblem kept = p.problem(), anew = p.problem();
  anew.keep_factor(false);
  const std::vector<unsigned char> active(p.contacts.size(), 3);
  VectorXd of_kept, of_anew;
  for (int times = 1; times <= 3; ++times) {
    ASSERT_TRUE(kept.factorize(p.contacts, active) && anew.factorize(p.contacts, active));
    EXPECT_EQ(kept.cholesky().n_factorizations(), 1);
    EXPECT_EQ(anew.cholesky().n_factorizations(), times);
    kept.solve(p.g0, of_kept);
    anew.solve(p.g0, of_anew);
    EXPECT_EQ(of_kept, of_anew);
    for (ContactTerm& contact : p.contacts) contact.gap.constant += 1;  // the matrix knows nothing of it
  }
}

/// A direction that only an open contact would stop.
TEST(FrictionProblem, SaysWhenNothingHoldsAnUnknown) {
  ContactTerm wall;
  wall.gap.add(0, 1);
  wall.gap.constant = 1;
  wall.normal_stiffness = 1;
  wall.sheared = false;
  FrictionProblem problem({0}, 1);
  problem.set_matrices(listed({{0, 1}}));
  problem.elements()[0](0, 0) = 0;
  problem.matrices_changed();
  VectorXd x = VectorXd::Zero(1);
  EXPECT_EQ(problem.minimize({wall}, VectorXd::Ones(1), {}, x).status, MinimizeStatus::not_positive_definite);
  EXPECT_EQ(problem.minimize({wall}, VectorXd::Constant(1, std::nan("")), {}, x).status,
            MinimizeStatus::not_finite);
}

TEST(FrictionProblem, WithoutFreeUnknownsThereIsNothingToDo) {
  RandomProblem p(5);
  p.equation.assign(p.equation.size(), -1);
  const VectorXd start = p.vector();
  VectorXd d = start;
  const MinimizeReport report = p.problem().minimize(p.contacts, p.g0, p.options(), d);
  EXPECT_EQ(report.status, MinimizeStatus::converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(d, start);
}

/// Walls that all begin to act at the same place, where the unknown starts.
TEST(FrictionProblem, ManyContactsMayChangeAtOnce) {
  ContactTerm wall;
  wall.gap.add(0, 1);
  wall.slip.add(0, 0);
  wall.normal_stiffness = 1;
  const std::vector<ContactTerm> walls(50, wall);
  FrictionProblem problem({0}, 1);
  problem.set_matrices(listed({{0, 1}}));
  problem.elements()[0](0, 0) = 1;
  problem.matrices_changed();
  for (double start : {-1., 0., 1.}) {
    VectorXd x = VectorXd::Constant(1, start);
    const MinimizeReport report = problem.minimize(walls, VectorXd::Constant(1, 51), {}, x);
    EXPECT_EQ(report.status, MinimizeStatus::converged);
    EXPECT_NEAR(x[0], -1, 1e-14);
    EXPECT_LE(report.iterations, 3);
  }
}

TEST(FrictionProblem, OrdersLargeEquationsAnewWhereManyFactorsAreToCome) {
  for (const int n_blocks : {100, 5000}) {
    const int n = 6 * n_blocks;
    std::vector<int> equation(static_cast<std::size_t>(n));
    std::iota(equation.begin(), equation.end(), 0);
    FrictionProblem problem(equation, n);
    std::vector<Range> blocks;
    for (int b = 0; b < n_blocks; ++b) blocks.push_back({6 * b, 6});
    problem.set_matrices(listed(blocks));
    for (MatrixXd& matrix : problem.elements()) matrix.setIdentity();
    std::vector<ContactTerm> chain(static_cast<std::size_t>(n_blocks) - 1);
    for (int c = 0; c < n_blocks - 1; ++c) {
      ContactTerm& term = chain[static_cast<std::size_t>(c)];
      for (const int u : {6 * c, 6 * c + 6}) {
        term.gap.add(u, u == 6 * c ? 1 : -1);
        term.slip.add(u, 1);
      }
      term.normal_stiffness = term.tangential_stiffness = 10;
    }
    const std::vector<unsigned char> all(chain.size(), 3);
    const VectorXd b = VectorXd::LinSpaced(n, -1, 1);
    VectorXd before, after;
    ASSERT_TRUE(problem.factorize(chain, all));
    problem.solve(b, before);
    problem.order_for_many(chain);
    problem.order_for_many(chain);
    EXPECT_EQ(problem.cholesky().n_analyses(), n_blocks > 1000 ? 2 : 1) << n_blocks;
    ASSERT_TRUE(problem.factorize(chain, all));
    problem.solve(b, after);
    EXPECT_LT((after - before).norm(), 1e-13 * before.norm()) << n_blocks;
    problem.contacts_changed();
    ASSERT_TRUE(problem.factorize(chain, all));
    problem.solve(b, after);
    EXPECT_EQ(after, before) << "whatever was requested in the step before";
    EXPECT_EQ(problem.cholesky().n_analyses(), n_blocks > 1000 ? 3 : 1) << n_blocks;
  }
}
