#include <ddacontact/solver/augmented_contacts.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// A block of 2 m x 1 m on a plate, `depth` in it, in a step by the default mechanics.
struct PressedBlock {
  BuiltScene built;
  std::vector<Contact> list;
  StepSystem system;
  ContactSolverOptions options{std::nullopt, 1e-6};
  VectorXd d;

  explicit PressedBlock(double friction_angle = 30, double cohesion = 0)
      : built(build(scene(friction_angle, cohesion))),
        list(built.stepper->contacts_to_begin_with()),
        system(blocks_of(built)) {
    system.set_step(built.stepper->state(), step_start(built.stepper->state(), 0.01), 1e9);
    d = VectorXd::Zero(built.stepper->blocks().n_unknowns());
    system.linearize(d);
  }
  static Scene scene(double friction_angle, double cohesion) {
    Scene scene = rock_scene(0.01, 1);
    scene.contact.method = ContactMethod::staged;
    scene.contact.penetration_tolerance = 1e-6;
    scene.joints = {{"joint", friction_angle, cohesion, cohesion, std::nullopt}};
    scene.blocks = {block(rectangle(-2, -1, 12, 1), true), block(rectangle(0, 0, 2, 1))};
    return scene;
  }
  /// Moves the block as a rigid one in this step.
  void shift(const Vec2& by) {
    const Block& of = built.stepper->blocks().block(1);
    d.segment(of.unknowns().first, of.n_unknowns()) = of.translations() * by;
  }
  AugmentedContacts begun() {
    AugmentedContacts contacts(system, options, list);
    contacts.begin();
    look(contacts);
    return contacts;
  }
  void look(AugmentedContacts& contacts) {
    contacts.evaluate(d);
    contacts.find_springs(d);
    for (std::size_t c = 0; c < contacts.size(); ++c) contacts.forces()[c] = contacts.law_force(c);
  }
};

}  // namespace

/// Ten to a thousand times as stiff as the vertex against the block behind it, whatever was requested.
TEST(AugmentedContacts, StiffnessesAreBoundedByThoseOfTheBlocks) {
  for (const double asked : {1., 1e20}) {
    PressedBlock block;
    for (Contact& contact : block.list) {
      contact.law.normal_stiffness = asked;
      contact.law.tangential_stiffness = 0.4 * asked;
    }
    block.begun();
    for (const Contact& contact : block.list) {
      const double vertex = block.system.vertex_stiffness(1, contact.pair.vertex, {0, 1});
      EXPECT_DOUBLE_EQ(contact.law.normal_stiffness, (asked == 1 ? 10 : 1000) * vertex);
      EXPECT_DOUBLE_EQ(contact.law.tangential_stiffness, 0.4 * contact.law.normal_stiffness);
    }
  }
}

TEST(AugmentedContacts, BeginWithTheForcesOfTheStepBefore) {
  PressedBlock block;
  for (Contact& contact : block.list) {
    contact.history.normal = 7e3;
    contact.history.shear = -2e3;
  }
  const AugmentedContacts contacts = block.begun();
  ASSERT_EQ(contacts.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_NEAR(contacts.law_force(c).normal, 7e3, 1);
    EXPECT_NEAR(contacts.law_force(c).shear, -2e3, 1);
  }
}

/// N = lambda - p g and T = tau - p_t s, within the bound of friction under that N.
TEST(AugmentedContacts, ForcesFollowGapAndSlipWithinFriction) {
  PressedBlock block;
  for (Contact& contact : block.list) contact.history.normal = 7e3;
  AugmentedContacts contacts = block.begun();
  const JointLaw& law = block.list[0].law;
  const double start = contacts.law_force(0).normal, deeper = 1e3 / law.normal_stiffness;
  for (const double slip : {0.5e3 / law.tangential_stiffness, 1.}) {
    block.shift({-slip, -deeper});
    block.look(contacts);
    EXPECT_NEAR(contacts.law_force(0).normal - start, 1e3, 1e-3);
    const double bound = std::tan(radians(30)) * contacts.law_force(0).normal;
    // The plate's upper side runs to the left, and so does the slip.
    EXPECT_NEAR(contacts.law_force(0).shear, slip < 1 ? -0.5e3 : -bound, 1);
    EXPECT_EQ(contacts.law_states()[0], slip < 1 ? normal_acts | shear_acts : normal_acts | at_lower);
  }
  contacts.settle(0);
  EXPECT_EQ(block.list[0].history.state, ContactState::slip_forward) << "friction points backwards";
  block.shift({0, 1e-3});
  block.look(contacts);
  EXPECT_EQ(contacts.law_force(0).normal, 0);
  contacts.settle(0);
  EXPECT_EQ(block.list[0].history.state, ContactState::open);
}

/// A dynamic step makes good a fifth of the gap of a closed contact, a static one all but a rest.
TEST(AugmentedContacts, CorrectAPartOfTheGapThatTheyBeginWith) {
  const double most = 1e-6 * std::sqrt(2), depth = 0.5 * most;
  for (const bool is_static : {false, true}) {
    PressedBlock block;
    block.options.is_static = is_static;
    for (Contact& contact : block.list) {
      contact.history.gap_offset = depth;  // lies as much too deep
      contact.history.normal = 7e3;
    }
    const AugmentedContacts contacts = block.begun();
    const double corrected = is_static ? depth - negligible_gap * most : 0.2 * depth;
    for (std::size_t c = 0; c < 2; ++c)
      EXPECT_NEAR(contacts.law_force(c).normal - 7e3, block.list[c].law.normal_stiffness * corrected, 1e-3);
  }
}

TEST(AugmentedContacts, MultipliersTakeOverForces) {
  PressedBlock block;
  AugmentedContacts contacts = block.begun();
  block.shift({0, -1e-6});
  block.look(contacts);
  const double pressed = contacts.law_force(0).normal;
  EXPECT_GT(pressed, 0);
  contacts.raise_multipliers(block.d);
  block.shift({0, 0});
  block.look(contacts);
  EXPECT_NEAR(contacts.law_force(0).normal, pressed, 1e-9 * pressed);
}

TEST(AugmentedContacts, AreCloseWithinTheToleranceOfTheBlockSize) {
  PressedBlock block;
  AugmentedContacts contacts = block.begun();
  int worst = 0;
  for (const double tolerances : {0.9, 1.1}) {
    block.shift({0, -tolerances * 1e-6 * std::sqrt(2)});
    block.look(contacts);
    EXPECT_EQ(contacts.are_close(block.d, 1, worst), tolerances < 1);
    EXPECT_EQ(worst >= 0, tolerances > 1);
    EXPECT_TRUE(contacts.are_close(block.d, 10, worst));
  }
}

TEST(AugmentedContacts, BondsBreakWhereTheyGiveWayAndNotBefore) {
  for (const double pull : {0.9, 1.1}) {
    PressedBlock block(30, 1e4);  // each corner bears 1e4 N
    AugmentedContacts contacts = block.begun();
    EXPECT_TRUE(contacts.is_bonded(0));
    block.shift({0, pull * 1e4 / block.list[0].law.normal_stiffness});
    block.look(contacts);
    EXPECT_NEAR(contacts.law_force(0).normal, -std::min(pull, 1.) * 1e4, 1);
    EXPECT_EQ(contacts.break_bonds(block.d), pull > 1);
    EXPECT_EQ(contacts.is_bonded(0), pull < 1);
    EXPECT_EQ(block.list[0].history.bonded, pull < 1);
  }
}

/// A brittle bond is lost by slip too, a ductile one is not.
TEST(AugmentedContacts, BrittleBondsBreakBySlip) {
  for (const bool ductile : {false, true}) {
    PressedBlock block(30, 1e4);
    for (Contact& contact : block.list) contact.law.ductile = ductile;
    AugmentedContacts contacts = block.begun();
    block.shift({1, 0});
    block.look(contacts);
    EXPECT_NEAR(contacts.law_force(0).shear, 1e4, 1);
    EXPECT_EQ(contacts.break_bonds(block.d), !ductile);
  }
}

/// Shear at the bound changes by tan(phi) of the normal force, against the slip.
TEST(AugmentedContacts, CouplingsAreTheDerivativeOfTheFrictionBound) {
  PressedBlock block;
  for (Contact& contact : block.list) contact.history.normal = 7e3;
  AugmentedContacts contacts = block.begun();
  EXPECT_TRUE(contacts.couplings(contacts.law_states()).empty()) << "they stick";
  for (const double way : {-1., 1.}) {
    block.shift({way, 0});
    block.look(contacts);
    const std::vector<Coupling> couplings = contacts.couplings(contacts.law_states());
    ASSERT_EQ(couplings.size(), 2u);
    EXPECT_NEAR(couplings[0].rate, way * std::tan(radians(30)) * block.list[0].law.normal_stiffness,
                1e-9 * block.list[0].law.normal_stiffness);
    EXPECT_EQ(couplings[0].contact, 0u);
  }
}
