#include <ddacontact/solver/relaxation.hpp>
#include <polyfem/core/parallel.hpp>
#include <tests/ddacontact/solver/random_blocks.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace support;
using Normal = ContactTerm::Normal;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Contacts of all kinds that begin with any forces, and loads.
struct Relaxed {
  RandomBlocks blocks;
  FrictionProblem problem;
  BlockGroups groups;
  ContactRelaxation relaxation;
  std::vector<JointLaw> joints;
  std::vector<RelaxedLaw> laws;
  std::vector<ContactForce> forces;
  VectorXd load, d;

  Relaxed(unsigned seed, int n_blocks, int n_contacts)
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
    EXPECT_TRUE(groups.set(problem, blocks.contacts));
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
  int relax() { return relaxation.relax(problem, groups, blocks.contacts, laws, residual(), d, forces); }
  bool is_bonded(std::size_t c) const { return blocks.contacts[c].bound == infinity; }
  /// What the law demands at d.
  ContactForce law_at_d(std::size_t c) const {
    const ContactTerm& term = blocks.contacts[c];
    ContactForce force;
    if (term.normal == Normal::absent) return force;
    force.normal = term.normal_multiplier - term.normal_stiffness * term.gap(d);
    if (term.normal == Normal::unilateral) force.normal = std::max(0.0, force.normal);
    if (!term.sheared) return force;
    const double bound = is_bonded(c) ? infinity : joints[c].friction * force.normal;
    const double multiplier =
        laws[c].sliding ? std::copysign(bound, laws[c].shear) : std::clamp(laws[c].shear, -bound, bound);
    force.shear = std::clamp(multiplier - term.tangential_stiffness * term.slip(d), -bound, bound);
    return force;
  }
};

/// A block that moves as a whole, against inertia, with one contact: gap = y, slip = x.
struct OnFloor {
  static constexpr double inertia = 100, p = 1000, p_t = 400, friction = 0.5;
  JointLaw joint;
  VectorXd d = VectorXd::Zero(2);
  std::vector<ContactForce> forces{1};

  explicit OnFloor(const Vec2& load, double cohesive_bound = 0) {
    FrictionProblem problem({0, 1}, 2);
    polyfem::Connectivity rows;
    rows.append(std::vector{0, 1});
    problem.set_matrices(rows);
    problem.elements()[0] = inertia * MatrixXd::Identity(2, 2);
    ContactTerm term;
    term.gap.add(0, 0);
    term.gap.add(1, 1);
    term.slip.add(0, 1);
    term.slip.add(1, 0);
    term.normal_stiffness = p;
    term.tangential_stiffness = p_t;
    term.bound = cohesive_bound;
    joint.friction = friction;
    BlockGroups groups;
    EXPECT_TRUE(groups.set(problem, {term}));
    ContactRelaxation relaxation;
    EXPECT_GT(relaxation.relax(problem, groups, {term}, {{&joint, 0, false}}, -load, d, forces), 0);
  }
};

}  // namespace

TEST(ContactRelaxation, ABlockOnAFloorSticksSlidesOrLiftsOffAsTheLawSays) {
  const double softer = OnFloor::inertia + OnFloor::p, softer_t = OnFloor::inertia + OnFloor::p_t;
  for (double push : {-40., -5., 0., 3., 60.})
    for (double weight : {-7., 1., 20.}) {
      const OnFloor block({push, -weight});
      const double N = std::max(0.0, OnFloor::p * weight / softer), bound = OnFloor::friction * N,
                   T = std::clamp(-OnFloor::p_t * push / softer_t, -bound, bound);
      EXPECT_NEAR(block.forces[0].normal, N, 1e-12);
      EXPECT_NEAR(block.forces[0].shear, T, 1e-12);
      EXPECT_NEAR(block.d[0], (push + T) / OnFloor::inertia, 1e-14);
      EXPECT_NEAR(block.d[1], (N - weight) / OnFloor::inertia, 1e-14);
    }
}

/// A bond of cohesion alone, which nothing keeps from opening.
TEST(ContactRelaxation, ABondBearsShearWhereNothingPressesIt) {
  for (double weight : {-7., 20.}) {
    const OnFloor block({60, -weight}, infinity);
    EXPECT_NEAR(block.forces[0].normal, std::max(0.0, OnFloor::p * weight / (OnFloor::inertia + OnFloor::p)),
                1e-12);
    EXPECT_NEAR(block.forces[0].shear, -OnFloor::p_t * 60 / (OnFloor::inertia + OnFloor::p_t), 1e-12);
  }
}

TEST(ContactRelaxation, DisplacementsBalanceForcesThatFrictionBears) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    Relaxed r(seed, 2 + static_cast<int>(seed) / 2, 2 * static_cast<int>(seed));
    const VectorXd before = r.d;
    EXPECT_GT(r.relax(), 0);
    EXPECT_LE(r.residual().norm(), 1e-12 * r.load.norm()) << seed;
    for (int u = 0; u < r.blocks.n_unknowns(); ++u) EXPECT_TRUE(r.d[u] == before[u] || !r.blocks.is_held(u));
    for (std::size_t c = 0; c < r.forces.size(); ++c) {
      const auto [normal, shear] = r.forces[c];
      const bool is_free = r.groups.place(r.blocks.contacts[c].gap.unknowns()[0]) >= 0;
      if (!is_free || r.blocks.contacts[c].normal == Normal::bilateral) continue;
      EXPECT_GE(normal, 0);
      EXPECT_TRUE(r.is_bonded(c) || std::abs(shear) <= r.joints[c].friction * normal * (1 + 1e-14))
          << seed << " contact " << c;
    }
  }
}

TEST(ContactRelaxation, RepeatedItFindsTheForcesOfTheLaw) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    Relaxed r(seed, 2 + static_cast<int>(seed) / 2, static_cast<int>(seed));
    for (int times = 0; times < 40; ++times) r.relax();
    for (std::size_t c = 0; c < r.forces.size(); ++c) {
      bool moves = false;
      for (int u : r.blocks.contacts[c].gap.unknowns()) moves = moves || !r.blocks.is_held(u);
      if (!moves) continue;
      const ContactForce law = r.law_at_d(c);
      EXPECT_NEAR(r.forces[c].normal, law.normal, 1e-3) << seed << " contact " << c;
      EXPECT_NEAR(r.forces[c].shear, law.shear, 1e-3) << seed << " contact " << c;
    }
  }
}

TEST(ContactRelaxation, GivesTheSameBytesForAnyNumberOfThreads) {
  std::vector<VectorXd> found;
  for (int threads : {1, 2, 3}) {
    polyfem::set_threads(threads);
    Relaxed r(1, 2 * BlockGroups::group_size + 900, 40000);
    ASSERT_EQ(r.groups.n_groups(), 3);
    const std::vector<ContactForce> before = r.forces;
    EXPECT_GT(r.relax(), 0);
    for (int k = 0; k < r.groups.n_neighbours(); ++k) {
      const auto c = static_cast<std::size_t>(r.groups.neighbour(k).contact);
      if (r.blocks.contacts[c].normal == Normal::absent) continue;
      EXPECT_NE(r.forces[c].normal, before[c].normal) << "also of contacts between groups";
    }
    EXPECT_LE(r.residual().norm(), 1e-12 * r.load.norm());
    found.push_back(r.d);
  }
  polyfem::set_threads(1);
  EXPECT_EQ(found[1], found[0]);
  EXPECT_EQ(found[2], found[0]);
}

TEST(ContactRelaxation, RefusesABlockWithoutInverse) {
  Relaxed r(3, 6, 4);
  for (MatrixXd& matrix : r.problem.elements()) matrix.setZero();
  const VectorXd before = r.d;
  EXPECT_EQ(r.relax(), -1);
  EXPECT_EQ(r.d, before);
}
