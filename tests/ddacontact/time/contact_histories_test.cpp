// What contacts hand on at the end of a step, by hand-made contacts.
#include <ddacontact/time/contact_histories.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

constexpr double penalty = 1e9, of_joint = 4e7;

ContactProperties with_joint(const JointStrength& joint) {
  return {penalty, penalty, JointTable(joint), {0, 0}, ContactMethod::staged, 1e-6};
}

/// In a state, on a horizontal edge; open or sticking at the start.
Contact contact_in(ContactState state, double gap = 0, ContactState at_start = ContactState::stick) {
  Contact contact;
  contact.pair = {1, 0, 0, 2};
  contact.size = 1;
  contact.motion.start = {{0.5, -2e-3}, {0, 0}, {1, 0}};  // 2 mm apart
  contact.history.state = state;
  contact.start_state = at_start;
  contact.gap = gap;
  return contact;
}
Contact sliding(double normal, double slip) {
  Contact contact = contact_in(ContactState::slip_backward);
  contact.normal = normal;
  contact.slip_change = slip;
  return contact;
}
/// Its stiffness is that of the joint, over the length of the contact.
void make_compliant(Contact& contact) {
  contact.law.compliant = true;
  contact.law.normal_stiffness = of_joint;
  contact.law.tangential_stiffness = of_joint / 2;
}

ContactEnds end(std::vector<Contact>& contacts, const ContactProperties& properties, Energy& energy,
                Scheme scheme = Scheme::dda) {
  const BlockSystem none(std::vector<std::unique_ptr<Block>>{});
  StepRule rule;
  rule.scheme = scheme;
  return end_histories(none, BlockState(), rule, properties, contacts, energy);
}
/// Of a contact alone.
ContactEnds end(Contact& contact, const JointStrength& joint = {}) {
  Energy energy;
  std::vector<Contact> contacts{contact};
  const ContactEnds ends = end(contacts, with_joint(joint), energy);
  contact = contacts[0];
  return ends;
}

}  // namespace

TEST(ContactHistories, MultipliersAreHandedOnWithoutTheDashpot) {
  Contact contact = contact_in(ContactState::stick, 5e-4);
  contact.normal = 700;
  contact.shear = -30;
  contact.damping = 1e5;  // held back with 150 N
  end(contact);
  EXPECT_DOUBLE_EQ(contact.history.normal, 550);
  EXPECT_DOUBLE_EQ(contact.history.shear, -30);
  contact.normal = 0;  // a dashpot does not pull
  end(contact);
  EXPECT_EQ(contact.history.normal, 0);
}

TEST(ContactHistories, OpenContactsAndPenaltiesHandOnNoForce) {
  ContactProperties penalties = with_joint({});
  penalties.penetration_tolerance = 0;
  for (const bool opens : {false, true}) {
    Contact contact = contact_in(opens ? ContactState::open : ContactState::stick);
    contact.normal = contact.shear = contact.history.normal = contact.history.shear = 10;
    std::vector<Contact> contacts{contact};
    Energy energy;
    end(contacts, opens ? with_joint({}) : penalties, energy);
    EXPECT_EQ(contacts[0].history.normal, 0);
    EXPECT_EQ(contacts[0].history.shear, 0);
  }
}

/// Where a step's forces are the means of both ends, that of the end follows from that of the start.
TEST(ContactHistories, SpringsOfAJointHandOnTheForcesOfTheEnd) {
  for (const bool means : {false, true}) {
    Contact contact = contact_in(ContactState::stick, -1e-6);
    make_compliant(contact);
    contact.history.gap_offset = 2e-6;
    contact.history.shear = 10;
    contact.shear = 25;
    std::vector<Contact> contacts{contact};
    Energy energy;
    ContactProperties penalties = with_joint({.normal_stiffness = of_joint});
    penalties.penetration_tolerance = 0;
    end(contacts, penalties, energy, means ? Scheme::midpoint : Scheme::dda);
    EXPECT_DOUBLE_EQ(contacts[0].history.normal, of_joint * 3e-6);
    EXPECT_DOUBLE_EQ(contacts[0].history.shear, means ? 40 : 25);
    EXPECT_DOUBLE_EQ(contacts[0].end_gap, -3e-6);
  }
}

TEST(ContactHistories, BondsBreakBySlipOrOpeningAndThoseWithStrengthCount) {
  struct Case {
    ContactState state;
    double cohesion, friction;
    bool ductile, stays;
    long broken;
  };
  using enum ContactState;
  for (const Case& of : {Case{stick, 5, 1, false, true, 0}, Case{slip_forward, 5, 1, false, false, 1},
                         Case{slip_backward, 5, 1, true, true, 0}, Case{open, 5, 1, false, false, 1},
                         Case{open, 5, 1, true, false, 1}, Case{slip_forward, 0, 1, false, false, 0},
                         Case{slip_forward, 0, 0, false, true, 0}}) {
    for (const bool bonded : {true, false}) {
      Contact contact = contact_in(of.state);
      contact.start_bonded = contact.history.bonded = bonded;
      contact.law.cohesion = of.cohesion;
      contact.law.friction = of.friction;
      contact.law.ductile = of.ductile;
      EXPECT_EQ(end(contact).broken_bonds, bonded ? of.broken : 0);
      EXPECT_EQ(contact.history.bonded, bonded && of.stays);
    }
  }
  Contact pulled = contact_in(open);
  pulled.start_bonded = true;
  pulled.law.tension = 5;
  EXPECT_EQ(end(pulled).broken_bonds, 1);
}

TEST(ContactHistories, CountsClosedContactsAndTheDeepestWithoutItsOverlapOfTheStart) {
  std::vector<Contact> contacts{contact_in(ContactState::stick, -3e-5),
                                contact_in(ContactState::slip_forward, -9e-5),
                                contact_in(ContactState::open, -1)};
  contacts[1].history.gap_offset = -8e-5;
  Energy energy;
  const ContactEnds ends = end(contacts, with_joint({}), energy);
  EXPECT_EQ(ends.closed, 2);
  EXPECT_DOUBLE_EQ(ends.deepest, 3e-5);
  EXPECT_NEAR(contacts[1].end_gap, -1e-5, 1e-18);
}

/// What fits at the start fits again when blocks come back: forces of a cycle of loads end where they began.
TEST(ContactHistories, AnOpenContactKeepsTheGapThatCountsAsNone) {
  const auto left = [](double offset, double gap) {
    Contact contact = contact_in(ContactState::open, gap);
    contact.history.gap_offset = offset;
    end(contact);
    return contact.history.gap_offset;
  };
  for (const double offset : {-1e-3, 1e-4})
    for (const double gap : {-2e-3, -4e-4, 1e-5, 1e-3}) EXPECT_EQ(left(offset, gap), offset);
  EXPECT_EQ(left(-1e-13, 1e-5), 0) << "round-off";
}

/// Friction pays for the lift; a rigid joint lifts when the step is over, which the scheme gets.
TEST(ContactHistories, ASlidingContactRisesByItsDilationUpToTheMost) {
  const JointStrength joint{.dilation = 0.2, .dilation_slip = 0.05};
  double risen = 0;
  for (const auto& [slip, rise] : {std::pair{0.02, 0.004}, {-0.02, 0.004}, {0.02, 0.002}, {0.02, 0.0}}) {
    std::vector<Contact> contacts{sliding(1000, slip)};
    contacts[0].history.gap_offset = risen;
    Energy energy;
    end(contacts, with_joint(joint), energy);
    EXPECT_NEAR(contacts[0].history.gap_offset - risen, rise, 1e-15);
    EXPECT_NEAR(energy.friction_dissipated, -1000 * rise, 1e-11);
    EXPECT_NEAR(energy.total(), 0, 1e-12);
    risen = contacts[0].history.gap_offset;
  }
  Contact sticking = sliding(1000, 0.02);
  sticking.history.state = ContactState::stick;
  end(sticking, joint);
  EXPECT_EQ(sticking.history.gap_offset, 0);
}

/// What its spring takes of the slip does not lift; the next step rises by the lift, whatever the stiffness.
TEST(ContactHistories, DilationOfACompliantJointIsOfItsPlasticSlip) {
  const double k_n = of_joint, k_t = of_joint / 2, elastic = 1e-6, plastic = 1e-5, before = k_n * 2e-6;
  Contact contact = sliding(before, -(elastic + plastic));
  make_compliant(contact);
  contact.gap = -2e-6;
  contact.history.shear = 5;
  contact.shear = 5 + k_t * elastic;
  std::vector<Contact> contacts{contact};
  Energy energy;
  end(contacts, with_joint({.normal_stiffness = of_joint, .dilation = 0.3, .dilation_slip = 1}), energy);
  const double rise = 0.3 * plastic;
  EXPECT_NEAR(contacts[0].history.gap_offset, rise, 1e-15);
  EXPECT_NEAR(contacts[0].history.normal, before, 1e-10);
  EXPECT_NEAR(energy.friction_dissipated, -before * rise, 1e-15);
  EXPECT_NEAR(energy.total(), 0, 1e-15);
}
