/// \file The springs of a contact, their bounds and what they are derivatives of.
#include <ddacontact/solver/contact_term.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace ddacontact;
using support::uniform;

namespace {

/// Unknown 0 is the gap and unknown 1 the slip.
ContactTerm term_of(double bound, double tension = 0) {
  ContactTerm term;
  term.gap.add(0, 1);
  term.slip.add(1, 1);
  term.normal_stiffness = 10;
  term.tangential_stiffness = 4;
  term.normal_multiplier = 3;
  term.tangential_multiplier = -1;
  term.bound = bound;
  term.tension = tension;
  return term;
}

VectorXd at(double gap, double slip) {
  return Vec2(gap, slip);
}

}  // namespace

/// N = 3 - 10 g and T = -1 - 4 s, |T| <= 2.
TEST(ContactTerm, ForcesAreThoseOfSpringsWithinTheirBounds) {
  const ContactTerm term = term_of(2);
  EXPECT_DOUBLE_EQ(contact_force(term, at(-0.1, -0.5)).normal, 4);
  EXPECT_DOUBLE_EQ(contact_force(term, at(-0.1, -0.5)).shear, 1);
  EXPECT_EQ(contact_force(term, at(0.4, 1)).normal, 0);
  EXPECT_EQ(contact_force(term, at(0.4, 1)).shear, -2);
  EXPECT_EQ(contact_force(term, at(0.4, -9)).shear, 2);
}

TEST(ContactTerm, BondsPullWithTheirStrengthAndBilateralOnesWithAny) {
  ContactTerm term = term_of(2, 5);
  EXPECT_DOUBLE_EQ(contact_force(term, at(0.7, 0)).normal, -4);
  EXPECT_EQ(contact_force(term, at(0.9, 0)).normal, -5);
  term.normal = ContactTerm::Normal::bilateral;
  EXPECT_DOUBLE_EQ(contact_force(term, at(100, 0)).normal, -997);
}

TEST(ContactTerm, WithoutAnEdgeNothingActsAndWithoutShearNothingAlongIt) {
  ContactTerm term = term_of(inf, 5);
  term.sheared = false;
  EXPECT_EQ(contact_force(term, at(-1, 7)).normal, 13);
  EXPECT_EQ(contact_force(term, at(-1, 7)).shear, 0);
  EXPECT_EQ(active_springs(term, at(-1, 7)), normal_acts);
  term.sheared = true;
  EXPECT_EQ(contact_force(term, at(-1, 7)).shear, -29) << "infinity: it cannot slide";
  term.normal = ContactTerm::Normal::absent;
  EXPECT_EQ(contact_force(term, at(-1, 7)).normal, 0);
  EXPECT_EQ(contact_force(term, at(-1, 7)).shear, 0);
  EXPECT_EQ(active_springs(term, at(-1, 7)), none_acts);
}

/// At a bound the force follows where it can move away from it on either side.
TEST(ContactTerm, ASpringThatCannotMoveDoesNotAct) {
  EXPECT_TRUE((ClippedSpring{2, 1, -2, 2}.acts()));
  EXPECT_TRUE((ClippedSpring{-2, 1, -2, 2}.acts()));
  EXPECT_FALSE((ClippedSpring{2.1, 1, -2, 2}.acts()));
  EXPECT_FALSE((ClippedSpring{-2.1, 1, -2, 2}.acts()));
  EXPECT_FALSE((ClippedSpring{0, 1, 0, 0}.acts()));
}

/// The springs that act are those whose forces change with gap and slip, by their stiffness; as of a convex
/// potential no force grows with its gap or slip.
TEST(ContactTerm, ActiveSpringsAreThoseWhoseForcesChange) {
  std::mt19937 random(1);
  for (int k = 0; k < 1000; ++k) {
    const ContactTerm term = term_of(uniform(0, 4, random), k % 2 == 0 ? 0 : 2);
    const VectorXd d = at(uniform(-1, 1, random), uniform(-2, 2, random));
    const double h = 1e-6;
    const ContactForce here = contact_force(term, d), there = contact_force(term, d + at(h, h));
    const double by_gap = (there.normal - here.normal) / h, by_slip = (there.shear - here.shear) / h;
    const unsigned char active = active_springs(term, d);
    EXPECT_NEAR(by_gap, active & normal_acts ? -10 : 0, 1e-6) << k;
    EXPECT_NEAR(by_slip, active & shear_acts ? -4 : 0, 1e-6) << k;
    const VectorXd far = at(uniform(-1, 1, random), uniform(-2, 2, random));
    const ContactForce other = contact_force(term, far);
    EXPECT_LE((other.normal - here.normal) * (far[0] - d[0]), 0);
    EXPECT_LE((other.shear - here.shear) * (far[1] - d[1]), 0);
  }
}
