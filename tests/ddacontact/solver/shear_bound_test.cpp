/// \file Every solver bounds shear as the joint's law does.
#include <ddacontact/contact/joint_law.hpp>
#include <ddacontact/solver/interior_contact.hpp>
#include <ddacontact/solver/spring_state.hpp>
#include <ddacontact/solver/swept_contact.hpp>
#include <ddacontact/time/rigid_velocities.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace ddacontact;
using support::uniform;

namespace {

/// A law drawn by lot: with a friction of its own or a coefficient or none, with or without a bond.
struct AnyLaw {
  FrictionLaw curve;
  JointLaw joint;
  bool bonded;
  ContactTerm term;

  explicit AnyLaw(std::mt19937& random) : bonded(random() % 2 == 0) {
    joint.friction = random() % 4 == 0 ? 0 : uniform(0, 1, random);
    joint.cohesion = random() % 2 == 0 ? 0 : uniform(0, 20, random);
    joint.tension = uniform(0, 20, random);
    if (random() % 3 == 0) {
      const double steepness = uniform(0.1, 5, random);
      curve = [=](double normal) { return std::sqrt(1 + steepness * normal) - 1; };
      joint.friction_law = &curve;
    }
    term.normal_stiffness = uniform(1, 10, random);
    term.tangential_stiffness = uniform(1, 10, random);
    term.tension = bonded ? joint.tension : 0;
    term.bound = bound(uniform(0, 30, random));
  }
  AnyLaw(const AnyLaw&) = delete;
  AnyLaw& operator=(const AnyLaw&) = delete;

  double bound(double normal) const { return shear_bound(joint, normal, bonded); }
  SweptLaw swept() const {
    SweptLaw law;
    law.joint = &joint;
    law.bonded = bonded;
    return law;
  }
};

void for_any_laws(const auto& check) {
  std::mt19937 random(1);
  for (int k = 0; k < 500; ++k) {
    SCOPED_TRACE(k);
    check(AnyLaw(random), random);
  }
}

}  // namespace

TEST(ShearBound, OfSweptContactsIsThatOfTheLaw) {
  for_any_laws([](const AnyLaw& law, std::mt19937& random) {
    SweptContact contact;
    contact.set_law(law.term, law.swept(), VectorXd());
    for (int k = 0; k < 5; ++k) {
      const double N = uniform(-30, 30, random);
      EXPECT_DOUBLE_EQ(contact.bound_under(N), law.bound(N)) << N;
    }
  });
}

/// Not clipped where nothing presses: there the line of friction goes on.
TEST(ShearBound, OfStatesOfSpringsIsThatOfTheLaw) {
  for_any_laws([](const AnyLaw& law, std::mt19937& random) {
    const double N = uniform(law.bonded ? -law.term.tension : 0.1, 30, random), bound = law.bound(N);
    const ContactSprings springs{{N, 1, -law.term.tension, inf}, {0, 1, -bound, bound}};
    for (const unsigned char side : {at_upper, at_lower}) {
      const ContactForce force =
          force_in_state(law.joint, law.bonded, static_cast<unsigned char>(normal_acts | side), springs);
      EXPECT_DOUBLE_EQ(force.normal, N);
      EXPECT_DOUBLE_EQ(force.shear, side == at_upper ? bound : -bound);
    }
    const auto slips = [&](double shear) {
      return state_of(law.term, law.joint, law.bonded, {N, shear}) & (at_upper | at_lower);
    };
    if (law.term.bound == 0 && !law.joint.has_friction()) return;  // no shear at all
    if (bound > 0) {
      EXPECT_EQ(slips(0.999 * bound), 0);
      EXPECT_EQ(slips(-0.999 * bound), 0);
    }
    EXPECT_EQ(slips(1.001 * bound + 1e-9), at_upper);
    EXPECT_EQ(slips(-1.001 * bound - 1e-9), at_lower);
  });
}

/// Bilateral contacts are pulled as well.
TEST(ShearBound, OfTheInteriorPointMethodIsThatOfTheLaw) {
  int n_pulled = 0;
  for_any_laws([&](AnyLaw&& law, std::mt19937& random) {
    law.term.gap.constant = uniform(-5, 5, random);
    if (random() % 2 == 0) law.term.normal = ContactTerm::Normal::bilateral;
    InteriorContact contact;
    contact.evaluate(law.term, law.swept(), VectorXd(), 1e-3);
    if (!contact.sheared) return;
    EXPECT_DOUBLE_EQ(contact.b, law.bound(contact.N()));
    n_pulled += contact.N() < 0;
  });
  EXPECT_GT(n_pulled, 100);
}

/// Impulses have no bond: it breaks, or nothing moves.
TEST(ShearBound, OfImpactsIsThatOfTheLawWithoutABond) {
  for_any_laws([](const AnyLaw& law, std::mt19937& random) {
    ImpactContact contact;
    contact.friction = law.joint.friction;
    if (law.joint.friction_law) contact.friction_law = *law.joint.friction_law;
    const double N = uniform(0, 30, random);
    EXPECT_DOUBLE_EQ(contact.bound(N), shear_bound(law.joint, N, false));
    EXPECT_EQ(contact.bound(0), 0);
  });
}
