#include <ddacontact/solver/contact_solution.hpp>

#include <tests/support/contact_walls.hpp>

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <random>
#include <string>

using namespace ddacontact;

namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

struct RandomProblem {
  std::mt19937 random;
  ContactProblem problem;

  explicit RandomProblem(unsigned seed) : random(seed) {}
  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
  VectorXd vector(int n) {
    return VectorXd::NullaryExpr(n, [&] { return uniform(-1, 1); });
  }
  /// Some bodies, diagonal and dense; contacts with rates of comparable size.
  void fill(int n_bodies, int n_contacts, const std::function<CoulombLaw(int)>& law) {
    for (int b = 0; b < n_bodies; ++b) {
      const int n = 3 + b % 3;
      if (b % 2 == 0) {
        problem.add_body(VectorXd::NullaryExpr(n, [&] { return uniform(0.5, 2); }), vector(n));
      } else {
        MatrixXd root(n, n);
        for (int j = 0; j < n; ++j) root.col(j) = vector(n);
        problem.add_body(MatrixXd(root * root.transpose() + 0.5 * MatrixXd::Identity(n, n)), vector(n));
      }
      problem.body_scale.back() = 1;
    }
    const VectorXd none;
    for (int c = 0; c < n_contacts; ++c) {
      const int one = c % n_bodies, other = c % 2 == 0 || n_bodies == 1 ? -1 : (c + 1) % n_bodies;
      const VectorXd n = vector(problem.count(one)), t = vector(problem.count(one)),
                     m = other < 0 ? none : vector(problem.count(other)),
                     s = other < 0 ? none : vector(problem.count(other));
      problem.add_contact({one, n, t}, {other, m, s}, {uniform(0, 0.3), 0}, law(c));
    }
  }
};

/// A unit impulse of contact j changes rate i by W(i, j); normals first, then shears.
struct Dual {
  MatrixXd W;
  VectorXd free;

  explicit Dual(ContactProblem problem) {
    const int n = problem.n_contacts();
    problem.impulses.assign(index(n), {});
    free = rates(problem);
    W.resize(2 * n, 2 * n);
    for (int j = 0; j < 2 * n; ++j) {
      NormalAndShear& impulse = problem.impulses[index(j % n)];
      impulse = j < n ? NormalAndShear{1, 0} : NormalAndShear{0, 1};
      W.col(j) = rates(problem) - free;
      impulse = {};
    }
    for (int c = 0; c < n; ++c) {
      W(c, c) += problem.law(c).normal_compliance;
      W(n + c, n + c) += problem.law(c).shear_compliance;
    }
  }
  static VectorXd rates(const ContactProblem& problem) {
    const int n = problem.n_contacts();
    const VectorXd z = problem.velocity();
    VectorXd result(2 * n);
    for (int c = 0; c < n; ++c) {
      const NormalAndShear rate = problem.rates(c, z);
      result[c] = rate.normal;
      result[n + c] = rate.shear;
    }
    return result;
  }
};

/// All impulses that obey the laws of a problem with tan(phi), by trying each combination of states.
std::vector<VectorXd> enumerate(const ContactProblem& problem) {
  const Dual dual(problem);
  const int n = problem.n_contacts();
  std::vector<VectorXd> found;
  std::vector<int> state(index(n), 0);  // 0 open, 1 stick, 2 and 3 slip with q = +F and -F
  for (;;) {
    MatrixXd K = MatrixXd::Identity(2 * n, 2 * n);
    VectorXd right = VectorXd::Zero(2 * n);
    for (int c = 0; c < n; ++c) {
      const int s = problem.law(c).bonded ? 1 : state[index(c)];
      if (s > 0) {
        K.row(c) = dual.W.row(c);
        right[c] = -dual.free[c];
      }
      if (s == 1) {
        K.row(n + c) = dual.W.row(n + c);
        right[n + c] = -dual.free[n + c];
      } else if (s > 1) {
        K(n + c, c) = (s == 2 ? -1 : 1) * problem.law(c).friction;
      }
    }
    const VectorXd p = K.fullPivLu().solve(right), u = dual.W * p + dual.free;
    bool holds = (K * p - right).norm() < 1e-9;
    constexpr double slack = 1e-10;
    for (int c = 0; c < n && holds; ++c) {
      if (problem.law(c).bonded) continue;
      const double F = problem.law(c).friction * p[c];
      const int s = state[index(c)];
      holds = s == 0   ? u[c] >= -slack
              : s == 1 ? p[c] >= -slack && std::abs(p[n + c]) <= F + slack
              : s == 2 ? p[c] >= -slack && u[n + c] <= slack
                       : p[c] >= -slack && u[n + c] >= -slack;
    }
    if (holds) found.push_back(p);
    int c = 0;
    while (c < n && ++state[index(c)] == 4) state[index(c++)] = 0;
    if (c == n) return found;
  }
}

double distance(const ContactProblem& problem, const VectorXd& p) {
  const int n = problem.n_contacts();
  double largest = 0;
  for (int c = 0; c < n; ++c)
    largest = std::max({largest, std::abs(problem.impulses[index(c)].normal - p[c]),
                        std::abs(problem.impulses[index(c)].shear - p[n + c])});
  return largest;
}

CoulombLaw rough(double friction) {
  CoulombLaw law;
  law.friction = friction;
  return law;
}

/// A block of mass 1 on a plane that is inclined against gravity's impulse (-push along it, -1 onto it).
ContactProblem sliding(double push, const CoulombLaw& law) {
  ContactProblem problem;
  const VectorXd none;
  problem.add_body(VectorXd::Ones(2), Eigen::Vector2d(push, -1));
  problem.body_scale.back() = 1;
  problem.add_contact({0, Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 0)}, {-1, none, none}, {}, law);
  return problem;
}

/// Work of the impulses at the mean velocity that is gained: p . u - p W p / 2 with u at the end.
double energy_gained(const ContactProblem& problem, const VectorXd& z) {
  double before = 0, after = 0;
  for (int b = 0; b < problem.n_bodies(); ++b) {
    const int first = problem.first(b), n = problem.count(b);
    for (const bool end : {false, true}) {
      const VectorXd x = (end ? z : problem.free_velocity()).segment(first, n);
      VectorXd momentum = VectorXd::Zero(n);
      problem.add_mass_times(b, x.data(), 1, momentum.data());
      (end ? after : before) += 0.5 * x.dot(momentum);
    }
  }
  return (after - before) / before;
}

}  // namespace

TEST(ContactSolution, AgreesWithAnEnumerationOfStates) {
  int n_solvable = 0, n_solved = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    RandomProblem r(seed);
    const bool compliant = seed % 4 == 1, bonds = seed % 4 == 2;
    r.fill(3, 5, [&](int c) {
      CoulombLaw law = rough(r.uniform(0, 1));
      if (compliant) law.normal_compliance = law.shear_compliance = 0.5;
      law.bonded = bonds && c == 1;
      return law;
    });
    const std::vector<VectorXd> all = enumerate(r.problem);
    const ContactSolution solution = solve(r.problem);
    if (all.empty()) {
      EXPECT_FALSE(solution.solved) << seed;
      continue;
    }
    ++n_solvable;
    if (!solution.solved) continue;
    ++n_solved;
    double nearest = 1e300;
    for (const VectorXd& p : all) nearest = std::min(nearest, distance(r.problem, p));
    EXPECT_LT(nearest, 1e-6) << "seed " << seed << " of " << all.size() << " solutions";
  }
  EXPECT_GT(n_solvable, 150);
  EXPECT_GE(n_solved, n_solvable * 99 / 100) << "of " << n_solvable;
}

TEST(ContactSolution, OneContactSticksAndSlidesAsItsLawSays) {
  ContactProblem sticks = sliding(0.4, rough(0.5)), slides = sliding(0.8, rough(0.5));
  EXPECT_NEAR(solve(sticks).velocity.norm(), 0, 1e-15);
  EXPECT_NEAR(solve(slides).velocity[0], 0.3, 1e-15);
}

TEST(ContactSolution, FollowsAFrictionLaw) {
  const FrictionLaw law_of_force = [](double force) { return 3 * force / (1 + force); };
  CoulombLaw law;
  law.friction_law = &law_of_force;
  law.time = 0.5;
  ContactProblem problem = sliding(2, law);
  const ContactSolution solution = solve(problem);
  ASSERT_TRUE(solution.solved);
  EXPECT_NEAR(problem.impulses[0].normal, 1, 1e-12);
  EXPECT_NEAR(problem.impulses[0].shear, -1, 1e-12);  // .5 * 3 * 2 / (1 + 2)
}

TEST(ContactSolution, BodiesWithoutContactsKeepTheirVelocities) {
  ContactProblem problem = sliding(0.8, rough(0.5));
  const Eigen::Vector3d free(0.1, 0.2, 0.3);
  problem.add_body(VectorXd::Ones(3), free);
  const VectorXd z = solve(problem).velocity;
  EXPECT_EQ(z.tail(3), free);
}

TEST(ContactSolution, IslandsDoNotFeelEachOther) {
  RandomProblem together(3), alone(3);
  const auto law = [](int) { return rough(0.4); };
  alone.fill(3, 5, law);
  together.fill(3, 5, law);
  const VectorXd none;
  together.problem.add_body(VectorXd::Ones(2), Eigen::Vector2d(1, -5));
  together.problem.add_contact({3, Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 0)}, {-1, none, none}, {},
                               rough(0.1));
  ASSERT_TRUE(solve(alone.problem).solved);
  ASSERT_TRUE(solve(together.problem).solved);
  for (std::size_t c = 0; c < 5; ++c) {
    EXPECT_EQ(alone.problem.impulses[c].normal, together.problem.impulses[c].normal);
    EXPECT_EQ(alone.problem.impulses[c].shear, together.problem.impulses[c].shear);
  }
}

TEST(ContactSolution, ASolvedProblemIsLeftAsItIs) {
  support::QuadrilateralSystem system(support::stack(5), 1e10, 0.6);
  ContactProblem problem = system.problem(0.01);
  for (int i = 0; i < 5; ++i) solve(problem);
  const std::vector<NormalAndShear> before = problem.impulses;
  const ContactSolution again = solve(problem);
  ASSERT_LE(again.residual.relative, 1e-12);
  EXPECT_EQ(again.counts.factorizations, 0);
  EXPECT_EQ(again.counts.sweeps, 0);
  for (std::size_t c = 0; c < before.size(); ++c) {
    EXPECT_EQ(before[c].normal, problem.impulses[c].normal);
    EXPECT_EQ(before[c].shear, problem.impulses[c].shear);
  }
}

TEST(ContactSolution, SaysWhenThereIsNone) {
  // Squeezed from both sides into less room than there is.
  ContactProblem problem;
  const VectorXd none;
  problem.add_body(VectorXd::Ones(2), Eigen::Vector2d(0.1, 0));
  problem.body_scale.back() = 1;
  for (const double side : {1.0, -1.0})
    problem.add_contact({0, Eigen::Vector2d(side, 0), Eigen::Vector2d(0, 1)}, {-1, none, none}, {-1, 0},
                        rough(0.5));
  const ContactSolution solution = solve(problem);
  EXPECT_FALSE(solution.solved);
  EXPECT_GT(solution.residual.relative, 1e-8);
  EXPECT_TRUE(solution.velocity.allFinite());
}

TEST(ContactSolution, ScalesWithUnitsOfPowersOfTwo) {
  const auto build = [](double mass, double velocity) {
    RandomProblem r(11);
    r.fill(3, 5, [](int) { return rough(0.5); });
    ContactProblem scaled;
    for (int b = 0; b < r.problem.n_bodies(); ++b) {
      const VectorXd free =
          velocity * r.problem.free_velocity().segment(r.problem.first(b), r.problem.count(b));
      if (r.problem.is_diagonal(b))
        scaled.add_body(
            VectorXd(mass * Eigen::Map<const VectorXd>(r.problem.diagonal(b).data(), r.problem.count(b))),
            free);
      else
        scaled.add_body(MatrixXd(mass * r.problem.dense(b)), free);
      scaled.body_scale.back() = mass * velocity * r.problem.body_scale[index(b)];
    }
    const auto row = [](std::span<const double> values) {
      return VectorXd(Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size())));
    };
    for (int c = 0; c < r.problem.n_contacts(); ++c)
      scaled.add_contact(
          {r.problem.body(c, 0), row(r.problem.normal_row(c, 0)), row(r.problem.shear_row(c, 0))},
          {r.problem.body(c, 1), row(r.problem.normal_row(c, 1)), row(r.problem.shear_row(c, 1))},
          {velocity * r.problem.offsets[index(c)].normal, 0}, r.problem.law(c));
    return scaled;
  };
  ContactProblem plain = build(1, 1), scaled = build(1024, 0.25);
  ASSERT_TRUE(solve(plain).solved);
  ASSERT_TRUE(solve(scaled).solved);
  for (std::size_t c = 0; c < plain.impulses.size(); ++c) {
    EXPECT_NEAR(256 * plain.impulses[c].normal, scaled.impulses[c].normal, 1e-8);
    EXPECT_NEAR(256 * plain.impulses[c].shear, scaled.impulses[c].shear, 1e-8);
  }
}

TEST(ContactSolution, ContactsNeverGiveEnergyWhereNothingPenetrates) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    RandomProblem r(1000 + seed);
    r.fill(4, 8, [&](int) { return rough(r.uniform(0, 1)); });
    const ContactSolution solution = solve(r.problem);
    if (solution.solved) {
      EXPECT_LE(energy_gained(r.problem, solution.velocity), 1e-9) << seed;
    }
  }
}

TEST(ContactSolution, CarriesAStackOfAHundred) {
  support::QuadrilateralSystem system(support::stack(100), 1e10, 0.6);
  ContactProblem problem = system.problem(0.01);
  const ContactSolution solution = solve(problem);
  EXPECT_TRUE(solution.solved) << solution.residual.relative;
}

TEST(ContactSolution, AnArchStandsUnderSuddenGravity) {
  support::QuadrilateralSystem system(support::arch(11, 5, 6.5), 1e10, 0.7);
  double fastest = 0;
  for (int step = 0; step < 10; ++step) {
    ContactProblem problem = system.problem(0.01);
    const ContactSolution solution = solve(problem);
    ASSERT_TRUE(solution.solved) << "step " << step << ": " << solution.residual.relative;
    system.advance(problem, solution.velocity, 0.01);
    fastest = solution.velocity.head(2).norm();
  }
  EXPECT_LT(fastest, 1e-4);
}

/// Walls under sudden gravity: side, step (s), friction, modulus (Pa).
class WallSolution : public testing::TestWithParam<std::tuple<int, double, double, double>> {};

TEST_P(WallSolution, MeetsTheToleranceInEveryStep) {
  const auto [side, dt, friction, modulus] = GetParam();
  support::QuadrilateralSystem system(support::wall(side), modulus, friction);
  const int n_steps = side <= 10 ? 3 : 1;
  for (int step = 0; step < n_steps; ++step) {
    ContactProblem problem = system.problem(dt);
    const ContactSolution solution = solve(problem);
    EXPECT_TRUE(solution.solved) << "step " << step << ": " << solution.residual.relative;
    EXPECT_LE(energy_gained(problem, solution.velocity), 1e-9);
    EXPECT_LE(solution.counts.factorizations, 200);
    system.advance(problem, solution.velocity, dt);
  }
}

INSTANTIATE_TEST_SUITE_P(TenByTen, WallSolution,
                         testing::Combine(testing::Values(10), testing::Values(1, 1e-2, 1e-3),
                                          testing::Values(0.3, 0.7), testing::Values(10e9, 35e9)));
INSTANTIATE_TEST_SUITE_P(ThirtyByThirty, WallSolution,
                         testing::Combine(testing::Values(30), testing::Values(1e-2, 1e-3),
                                          testing::Values(0.3, 0.7), testing::Values(10e9)));

TEST(ContactSolution, AWallComesToRestAndStays) {
  support::QuadrilateralSystem system(support::wall(10), 10e9, 0.7);
  ContactSolution solution;
  for (int step = 0; step < 20; ++step) {
    ContactProblem problem = system.problem(0.01);
    solution = solve(problem);
    system.advance(problem, solution.velocity, 0.01);
  }
  EXPECT_TRUE(solution.solved);
  EXPECT_LT(solution.velocity.lpNorm<Eigen::Infinity>(), 1e-9);
}
