#include <ddacontact/solver/contact_sweeps.hpp>
#include <polyfem/core/parallel.hpp>
#include <tests/ddacontact/solver/random_blocks.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace support;
using Normal = ContactTerm::Normal;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tight = 1e-12;

ContactSweeps::Stop stop(double tolerance, int most) {
  return {.quiet = {tolerance}, .many_changes = {tolerance}, .most_sweeps = most};
}

/// Contacts of all kinds that begin with any forces, and loads.
struct Swept {
  RandomBlocks blocks;
  FrictionProblem problem;
  ContactSweeps sweeps;
  std::vector<JointLaw> joints;
  std::vector<SweptLaw> laws;
  std::vector<ContactForce> forces;
  VectorXd load, d;

  Swept(unsigned seed, int n_blocks, int n_contacts)
      : blocks(seed, n_blocks, n_contacts),
        problem(blocks.problem()),
        joints(blocks.contacts.size()),
        laws(blocks.contacts.size()),
        forces(blocks.contacts.size()),
        load(20 * blocks.vector(blocks.n_unknowns())),
        d(problem.free_part(blocks.vector(blocks.n_unknowns()))) {
    for (std::size_t c = 0; c < joints.size(); ++c) {
      ContactTerm& term = blocks.contacts[c];
      const int kind = blocks.integer(0, 9);
      term.normal = kind == 0 ? Normal::absent : kind == 1 ? Normal::bilateral : Normal::unilateral;
      if (kind == 1 || kind == 2) term.bound = infinity;
      term.normal_multiplier = blocks.uniform(0, 3);
      if (term.sheared) joints[c].friction = 0.3;
      laws[c] = {&joints[c], blocks.uniform(-1, 1), kind == 3};
      if (term.normal == Normal::absent) continue;
      forces[c].normal = blocks.uniform(0, 3);
      if (term.sheared) forces[c].shear = blocks.uniform(-0.9, 0.9);
    }
  }

  /// What is left of the forces on the blocks, those of contacts not clipped.
  VectorXd residual() const {
    VectorXd r = -load;
    for (std::size_t e = 0; e < blocks.unknowns.size(); ++e)
      r(blocks.unknowns[e]) += blocks.matrices[e] * d(blocks.unknowns[e]);
    for (std::size_t c = 0; c < forces.size(); ++c) {
      blocks.contacts[c].gap.add_gradient(-forces[c].normal, r);
      if (blocks.contacts[c].sheared) blocks.contacts[c].slip.add_gradient(-forces[c].shear, r);
    }
    return problem.free_part(r);
  }
  ContactSweeps::Report sweep(double tolerance, int most) {
    EXPECT_TRUE(sweeps.set(problem, blocks.contacts));
    return sweeps.sweep(blocks.contacts, laws, residual(), stop(tolerance, most), d, forces);
  }
  bool is_bonded(std::size_t c) const { return blocks.contacts[c].bound == infinity; }
  bool moves(std::size_t c) const {
    const auto u = blocks.contacts[c].gap.unknowns();
    return std::any_of(u.begin(), u.end(), [&](int k) { return !blocks.is_prescribed(k); });
  }
  /// What the law demands at d.
  ContactForce law_at_d(std::size_t c) const {
    const ContactTerm& term = blocks.contacts[c];
    ContactForce force;
    if (term.normal == Normal::absent) return force;
    force.normal = term.normal_multiplier - term.normal_stiffness * term.gap(d);
    if (term.normal == Normal::unilateral) force.normal = std::max(0.0, force.normal);
    if (!term.sheared) return force;
    const double bound = is_bonded(c) ? infinity : joints[c].friction * force.normal;
    force.shear = std::clamp(laws[c].shear - term.tangential_stiffness * term.slip(d), -bound, bound);
    return force;
  }
};

/// Blocks that move as a whole, against inertia, each with one contact: gap = y, slip = x.
struct OnFloor {
  static constexpr double inertia = 100, p = 1000, p_t = 400, friction = 0.5;
  JointLaw joint;
  VectorXd d;
  std::vector<ContactForce> forces;
  ContactSweeps::Report report;

  explicit OnFloor(const Vec2& load, double cohesive_bound = 0)
      : OnFloor({load}, {{}}, stop(tight, 50), cohesive_bound) {
    EXPECT_TRUE(report.settled);
  }
  /// \param[in] before  the forces of the contacts at the start
  OnFloor(const std::vector<Vec2>& loads, const std::vector<ContactForce>& before,
          const ContactSweeps::Stop& stop, double cohesive_bound = 0)
      : d(VectorXd::Zero(2 * static_cast<Index>(loads.size()))), forces(before) {
    const auto n = static_cast<int>(loads.size());
    std::vector<int> unknowns(2 * loads.size());
    std::iota(unknowns.begin(), unknowns.end(), 0);
    FrictionProblem problem(unknowns, 2 * n);
    polyfem::Connectivity rows;
    for (int b = 0; b < n; ++b) rows.append(std::vector{2 * b, 2 * b + 1});
    problem.set_matrices(rows);
    joint.friction = friction;
    std::vector<ContactTerm> terms;
    VectorXd residual(2 * n);
    for (int b = 0; b < n; ++b) {
      problem.elements()[b] = inertia * MatrixXd::Identity(2, 2);
      ContactTerm& term = terms.emplace_back();
      for (int axis : {0, 1}) {
        term.gap.add(2 * b + axis, axis);
        term.slip.add(2 * b + axis, 1 - axis);
      }
      term.normal_stiffness = p;
      term.tangential_stiffness = p_t;
      term.bound = cohesive_bound;
      residual.segment<2>(2 * b) = -loads[b] - Vec2(before[b].shear, before[b].normal);
    }
    ContactSweeps sweeps;
    EXPECT_TRUE(sweeps.set(problem, terms));
    report = sweeps.sweep(terms, std::vector<SweptLaw>(loads.size(), {&joint}), residual, stop, d, forces);
  }
};

}  // namespace

TEST(ContactSweeps, ABlockOnAFloorSticksSlidesOrLiftsOffAsTheLawSays) {
  const double lower_stiffness = OnFloor::inertia + OnFloor::p, softer_t = OnFloor::inertia + OnFloor::p_t;
  for (double push : {-40., -5., 0., 3., 60.})
    for (double weight : {-7., 1., 20.}) {
      const OnFloor block({push, -weight});
      const double N = std::max(0.0, OnFloor::p * weight / lower_stiffness), bound = OnFloor::friction * N,
                   T = std::clamp(-OnFloor::p_t * push / softer_t, -bound, bound);
      EXPECT_NEAR(block.forces[0].normal, N, 1e-11);
      EXPECT_NEAR(block.forces[0].shear, T, 1e-11);
      EXPECT_NEAR(block.d[0], (push + T) / OnFloor::inertia, 1e-13);
      EXPECT_NEAR(block.d[1], (N - weight) / OnFloor::inertia, 1e-13);
    }
}

/// A bond of cohesion alone, which nothing keeps from opening.
TEST(ContactSweeps, ABondBearsShearWhereNothingPressesIt) {
  for (double weight : {-7., 20.}) {
    const OnFloor block({60, -weight}, infinity);
    EXPECT_NEAR(block.forces[0].normal, std::max(0.0, OnFloor::p * weight / (OnFloor::inertia + OnFloor::p)),
                1e-11);
    EXPECT_NEAR(block.forces[0].shear, -OnFloor::p_t * 60 / (OnFloor::inertia + OnFloor::p_t), 1e-11);
  }
}

/// Of six contacts that are or were closed four change: one opens, one closes, one begins to slide, one turns
/// round.
TEST(ContactSweeps, TellWhetherManyOfTheClosedContactsChange) {
  const std::vector<Vec2> loads{{0, -20}, {0, 7}, {0, 7}, {0, -20}, {60, -20}, {60, -20}, {60, -20}};
  const std::vector<ContactForce> before{{20, 0}, {0, 0}, {20, 0}, {0, 0}, {20, 0}, {20, 10}, {20, -10}};
  const auto are_many = [&](double many, int few) {
    ContactSweeps::Stop until = stop(tight, 50);
    until.many = many;
    until.few = few;
    return OnFloor(loads, before, until).report.many_changes;
  };
  EXPECT_TRUE(are_many(0.66, 3));
  EXPECT_FALSE(are_many(0.67, 3));
  EXPECT_FALSE(are_many(0.66, 4));
}

TEST(ContactSweeps, DisplacementsBalanceForcesThatFrictionBearsAfterAnyNumberOfSweeps) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    Swept s(seed, 2 + static_cast<int>(seed) / 2, 2 * static_cast<int>(seed));
    const VectorXd before = s.d;
    s.sweep(0, 1 + 2 * static_cast<int>(seed % 5));
    EXPECT_LE(s.residual().norm(), 1e-11 * s.load.norm()) << seed;
    for (int u = 0; u < s.blocks.n_unknowns(); ++u)
      EXPECT_TRUE(s.d[u] == before[u] || !s.blocks.is_prescribed(u));
  }
}

TEST(ContactSweeps, FindTheForcesOfTheLaw) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    Swept s(seed, 2 + static_cast<int>(seed) / 2, 2 * static_cast<int>(seed));
    EXPECT_TRUE(s.sweep(tight, 2000).settled) << seed;
    for (std::size_t c = 0; c < s.forces.size(); ++c) {
      if (!s.moves(c)) continue;
      const ContactForce law = s.law_at_d(c);
      EXPECT_NEAR(s.forces[c].normal, law.normal, 1e-8) << seed << " contact " << c;
      EXPECT_NEAR(s.forces[c].shear, law.shear, 1e-8) << seed << " contact " << c;
    }
  }
}

/// From the solution one sweep is enough; and in the next step, whose load differs a little, few are.
TEST(ContactSweeps, BeginWithTheForcesThatTheyAreGiven) {
  Swept s(7, 20, 40);
  const int cold = s.sweep(1e-8, 2000).sweeps;
  EXPECT_EQ(s.sweep(1e-7, 2000).sweeps, 1);
  s.load *= 1 + 1e-6;
  const int warm = s.sweep(1e-8, 2000).sweeps;
  EXPECT_LT(warm, cold);
}

TEST(ContactSweeps, GiveTheSameBytesForAnyNumberOfThreads) {
  std::vector<VectorXd> found;
  for (int threads : {1, 2, 4}) {
    polyfem::set_threads(threads);
    Swept s(1, 2 * ContactSweeps::group_size + 900, 40000);
    const std::vector<ContactForce> before = s.forces;
    s.sweep(0, 7);
    ASSERT_EQ(s.sweeps.n_groups(), 3);
    for (std::size_t c = 0; c < s.forces.size(); ++c)
      EXPECT_TRUE(!s.moves(c) || s.blocks.contacts[c].normal == Normal::absent ||
                  s.forces[c].normal != before[c].normal)
          << "also of contacts between groups";
    found.push_back(s.d);
  }
  polyfem::set_threads(1);
  EXPECT_EQ(found[1], found[0]);
  EXPECT_EQ(found[2], found[0]);
}

TEST(ContactSweeps, WhereNumbersAreNoneHaveNotSettled) {
  Swept s(7, 20, 40);
  s.load[s.blocks.unknowns[1][0]] = std::numeric_limits<double>::quiet_NaN();
  s.load[s.blocks.unknowns[2][1]] = std::numeric_limits<double>::quiet_NaN();
  const ContactSweeps::Report report = s.sweep(1e-8, 2000);
  EXPECT_FALSE(report.settled);
  EXPECT_LT(report.sweeps, 10);
}

TEST(ContactSweeps, RefuseABlockWithoutInverseOrTooLargeOrOdd) {
  Swept s(3, 6, 4);
  for (MatrixXd& matrix : s.problem.elements()) matrix.setZero();
  EXPECT_FALSE(s.sweeps.set(s.problem, s.blocks.contacts));
  for (int n : {3, ContactSweeps::largest_block, ContactSweeps::largest_block + 2}) {
    std::vector<int> unknowns(static_cast<std::size_t>(n));
    std::iota(unknowns.begin(), unknowns.end(), 0);
    FrictionProblem problem(unknowns, n);
    polyfem::Connectivity rows;
    rows.append(unknowns);
    problem.set_matrices(rows);
    problem.elements()[0] = MatrixXd::Identity(n, n);
    EXPECT_EQ(s.sweeps.set(problem, {}), n == ContactSweeps::largest_block) << n;
  }
}
