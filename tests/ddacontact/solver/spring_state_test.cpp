/// \file The states of a contact's springs: of every force, and back.
#include <ddacontact/solver/spring_state.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace ddacontact;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A contact under these forces of its springs, before they are clipped.
struct Case {
  JointLaw law;
  ContactTerm term;
  ContactSprings springs;
  ContactForce clipped;
  bool bonded;

  Case(const JointLaw& of, bool bond, double normal, double shear) : law(of), bonded(bond) {
    term.tension = bonded ? law.tension : 0;
    springs.normal = {normal, 1, -term.tension, infinity};
    clipped.normal = springs.normal.clipped();
    term.bound = shear_bound(law, clipped.normal, bonded);
    springs.tangential = {shear, 1, -term.bound, term.bound};
    clipped.shear = springs.tangential.clipped();
  }
  unsigned char of_force() const { return state_of(term, law, bonded, clipped); }
};

const JointLaw rock{.friction = 0.5, .cohesion = 20, .tension = 10};

}  // namespace

TEST(SpringState, OfAForceIsWhatTheLawSays) {
  EXPECT_EQ(Case(rock, false, 100, 30).of_force(), normal_acts | shear_acts);
  EXPECT_EQ(Case(rock, false, 100, 60).of_force(), normal_acts | at_upper);
  EXPECT_EQ(Case(rock, false, 100, -60).of_force(), normal_acts | at_lower);
  EXPECT_EQ(Case(rock, false, -1, 30).of_force(), none_acts);
  EXPECT_EQ(Case(rock, true, -5, 10).of_force(), normal_acts | shear_acts) << "a bond bears tension";
  EXPECT_EQ(Case(rock, true, -50, 10).of_force(), shear_acts) << "and shear while it is pulled open";
  EXPECT_EQ(Case(rock, true, -50, -90).of_force(), at_lower);
  EXPECT_EQ(Case(JointLaw{}, false, 100, 30).of_force(), normal_acts) << "without friction";
}

TEST(SpringState, BilateralContactsAreClosedAndAbsentOnesOpen) {
  Case one(rock, false, -100, 0);
  one.term.normal = ContactTerm::Normal::bilateral;
  EXPECT_TRUE(state_of(one.term, rock, false, {-100, 0}) & normal_acts);
  one.term.normal = ContactTerm::Normal::absent;
  EXPECT_EQ(state_of(one.term, rock, false, {100, 0}), none_acts);
}

/// The state where the springs are evaluated is that of the clipped force, and gives this force back.
TEST(SpringState, OfSpringsIsThatOfTheirClippedForces) {
  std::mt19937 random(1);
  for (int k = 0; k < 1000; ++k) {
    const Case one(rock, k % 2 == 0, support::uniform(-30, 60, random), support::uniform(-60, 60, random));
    const unsigned char state = state_at(one.term, one.law, one.springs);
    ASSERT_EQ(state, one.of_force()) << k;
    if (state == none_acts) continue;
    const ContactForce force = force_in_state(one.law, one.bonded, state, one.springs);
    EXPECT_NEAR(force.normal, one.clipped.normal, 1e-12) << k;
    EXPECT_NEAR(force.shear, one.clipped.shear, 1e-12) << k;
  }
}

TEST(SpringState, SlipTurnsRoundByWayOfSticking) {
  EXPECT_EQ(next_state(normal_acts | at_upper, normal_acts | at_lower), normal_acts | shear_acts);
  EXPECT_EQ(next_state(normal_acts | at_lower, normal_acts | at_upper), normal_acts | shear_acts);
  EXPECT_EQ(next_state(normal_acts | at_upper, normal_acts | at_upper), normal_acts | at_upper);
  EXPECT_EQ(next_state(normal_acts | at_upper, none_acts), none_acts);
  EXPECT_EQ(next_state(none_acts, normal_acts | at_lower), normal_acts | at_lower);
}
