#include <ddacontact/solver/swept_contact.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace ddacontact;

namespace {

/// A contact with a random law, and blocks that answer to its forces by a random positive definite matrix.
struct RandomContact {
  std::mt19937_64 random;
  JointLaw joint;
  SweptContact contact;
  double shear = 0;          // its force at the start
  double gap = 0, slip = 0;  // without its own forces

  explicit RandomContact(unsigned seed) : random(seed) {
    joint.friction = uniform(0, 0.8);
    contact.normal = uniform(0.5, 2);
    contact.shear = uniform(0.5, 2);
    contact.mixed = uniform(-0.6, 0.6) * std::sqrt(contact.normal * contact.shear);
    ContactTerm term;
    term.normal_stiffness = uniform(0.1, 10);
    term.tangential_stiffness = uniform(0.1, 10);
    term.normal_multiplier = uniform(0, 2);
    term.bound = 1;
    shear = uniform(-1, 1);
    contact.set_law(term, {&joint, shear}, VectorXd());
    gap = contact.gap + uniform(-3, 3);
    slip = uniform(-3, 3);
  }
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
};

/// Gap and slip with the forces: the law's forces there are the same.
TEST(SweptContact, FindsForcesThatAreThoseOfTheLawWhereTheyLead) {
  int n_open = 0, n_stick = 0, n_slip = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    const RandomContact random(seed);
    const SweptContact& c = random.contact;
    const auto [N, T] = c.solve(random.gap, c.slip + random.slip);
    const double gap = random.gap + c.normal * N + c.mixed * T,
                 slip = random.slip + c.mixed * N + c.shear * T;
    const double bound = c.bound_under(N);
    EXPECT_NEAR(N, std::max(-c.tension, -gap / c.normal_compliance), 1e-11) << seed;
    EXPECT_NEAR(T, std::clamp(random.shear - slip / c.tangential_compliance, -bound, bound), 1e-11) << seed;
    ++(N == -c.tension ? n_open : std::abs(T) < bound ? n_stick : n_slip);
  }
  for (const int n : {n_open, n_stick, n_slip}) EXPECT_GT(n, 300);
}

TEST(SweptContact, WithoutFrictionOnlyPresses) {
  RandomContact random(1);
  random.joint.friction = 0;
  ContactTerm term;
  term.normal_stiffness = term.tangential_stiffness = 2;
  random.contact.set_law(term, {&random.joint}, VectorXd());
  const ContactForce pressed = random.contact.solve(-1, 5);
  EXPECT_DOUBLE_EQ(pressed.normal, 1 / (0.5 + random.contact.normal));
  EXPECT_EQ(pressed.shear, 0);
  EXPECT_EQ(random.contact.solve(1, 5).normal, 0);
}

TEST(SweptContact, BondsBearTheirCohesionWhateverPresses) {
  RandomContact random(2);
  random.joint.cohesion = 3;
  ContactTerm term;
  term.normal_stiffness = term.tangential_stiffness = 1e9;
  term.tension = term.bound = 1;
  SweptLaw law{&random.joint};
  law.bonded = true;
  random.contact.set_law(term, law, VectorXd());
  EXPECT_DOUBLE_EQ(random.contact.bound_under(-1), 3);
  EXPECT_EQ(random.contact.solve(100, 0).normal, -1);
}

}  // namespace
