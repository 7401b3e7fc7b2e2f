#include <ddacontact/solver/interior_contact.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace ddacontact;

namespace {

struct Law {
  JointLaw joint;
  ContactTerm term;
  SweptLaw swept;

  /// \param[in] bond  its tension and its cohesion, N per m
  Law(double gap, double slip, double friction, double bond = 0) {
    joint.friction = friction;
    term.gap.constant = gap;
    term.slip.constant = slip;
    term.normal_stiffness = 3;
    term.tangential_stiffness = 2;
    term.bound = 1;
    term.tension = joint.cohesion = bond;
    swept.joint = &joint;
    swept.bonded = bond > 0;
  }
};

/// The numbers of a contact that begins keep the equations of the method but for friction's slack.
TEST(InteriorContact, BeginsOnThePathOfItsNormalForce) {
  const Law law(-0.5, 0.2, 0.4);
  for (double mu : {1e-4, 1., 100.}) {
    InteriorContact contact;
    contact.evaluate(law.term, law.swept, VectorXd(), mu);
    EXPECT_NEAR(contact.normal.x - contact.normal.s, contact.a, 1e-12 * (1 + mu));
    for (const InteriorPair& pair : {contact.normal, contact.upper, contact.lower})
      EXPECT_NEAR(pair.x * pair.s, mu, 1e-12 * mu);
    EXPECT_LE(contact.longest(), 1);
  }
}

/// While mu falls its forces become those of the law at the same displacements, and the state that of it.
TEST(InteriorContact, ComesToItsLaw) {
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  for (int k = 0; k < 300; ++k) {
    const Law law(uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1), k % 3 == 0 ? 0.5 : 0);
    InteriorContact contact;
    double mu = 1;
    contact.evaluate(law.term, law.swept, VectorXd(), mu);
    for (int step = 0; step < 120; ++step) {
      contact.find_rates();
      contact.aim(mu, 0);
      contact.follow(0, 0);
      contact.advance(contact.longest());
      contact.evaluate(law.term, law.swept, VectorXd(), mu);
      mu *= 0.8;
    }
    const double N = std::max(-law.term.tension, -3 * law.term.gap.constant),
                 bound = law.joint.friction * std::max(0., N) + law.joint.cohesion,
                 T = std::clamp(-2 * law.term.slip.constant, -bound, bound);
    EXPECT_NEAR(contact.N(), N, 1e-6) << k;
    EXPECT_NEAR(contact.T, T, 1e-6) << k;
    if (N > 1e-3) {
      EXPECT_EQ(contact.state(law.swept), normal_acts | (T > bound - 1e-9    ? at_upper
                                                         : T < -bound + 1e-9 ? at_lower
                                                                             : shear_acts))
          << k;
    }
  }
}

/// Forces follow a change of gap and slip as their equations say, to first order.
TEST(InteriorContact, FollowsAChangeOfItsGapAndSlip) {
  const Law law(-0.5, 0.1, 0.4);
  InteriorContact contact;
  contact.evaluate(law.term, law.swept, VectorXd(), 0.1);
  contact.find_rates();
  contact.aim(0.1, 0);
  contact.follow(1e-3, 2e-3);
  EXPECT_NEAR(contact.normal.dx - contact.normal.ds, 3e-3 + contact.a - (contact.normal.x - contact.normal.s),
              1e-12);
  EXPECT_NEAR(contact.upper.x + contact.upper.dx - contact.rate * contact.normal.dx + contact.T + contact.dT,
              contact.b, 1e-12);
}

}  // namespace
