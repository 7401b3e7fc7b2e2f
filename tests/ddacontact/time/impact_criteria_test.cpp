/// \file Which contacts bear before an impact, how long impacts take, and which bonds survive them.
#include <ddacontact/time/impact_criteria.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// Blocks of 18 t and 4 t, of squares of 3 m and of 2 m x 1 m, and a held one; g = 10.
struct BlocksOfTwoSizes {
  BuiltScene built = build(scene());
  const BlockSystem& blocks = built.stepper->blocks();

  static Scene scene() {
    Scene scene = rock_scene(0.01, 1);
    scene.blocks = {block(rectangle(0, 0, 3, 3)), block(rectangle(5, 0, 2, 1)),
                    block(rectangle(10, 0, 1, 1), true)};
    return scene;
  }
};

constexpr double dt = 0.01;

Contact closed_between(int a, int b) {
  Contact contact;
  contact.pair = {a, 0, b, 0};
  contact.history.state = ContactState::stick;
  contact.size = 1;
  return contact;
}

}  // namespace

/// A thousandth of the weight of the lighter one of the blocks that may move.
TEST(ImpactCriteria, ContactsBearThatArePressedByAPartOfTheWeight) {
  const BlocksOfTwoSizes of_two_sizes;
  for (const auto& [a, b, mass] : {std::tuple(0, 1, 4e3), {1, 0, 4e3}, {0, 2, 18e3}, {2, 0, 18e3}}) {
    Contact contact = closed_between(a, b);
    contact.history.normal = 1.01e-3 * mass * 10;
    EXPECT_TRUE(bears(of_two_sizes.blocks, contact, dt));
    contact.history.normal = 0.99e-3 * mass * 10;
    EXPECT_FALSE(bears(of_two_sizes.blocks, contact, dt));
    contact.history.normal = 1e9;
    contact.history.state = ContactState::open;
    EXPECT_FALSE(bears(of_two_sizes.blocks, contact, dt));
  }
}

TEST(ImpactCriteria, BondsBearWhateverTheirForce) {
  const BlocksOfTwoSizes of_two_sizes;
  Contact contact = closed_between(0, 1);
  contact.history.normal = -100;
  EXPECT_FALSE(bears(of_two_sizes.blocks, contact, dt));
  contact.history.bonded = true;
  contact.law.cohesion = 1;
  EXPECT_TRUE(bears(of_two_sizes.blocks, contact, dt));
  contact.history.state = ContactState::open;
  EXPECT_FALSE(bears(of_two_sizes.blocks, contact, dt));
}

/// Without gravity impulses have to change the velocity of the lighter block by more than round-off.
TEST(ImpactCriteria, WithoutWeightRoundOffDecides) {
  Scene scene = BlocksOfTwoSizes::scene();
  scene.analysis.gravity = Vec2::Zero();
  const BuiltScene built = build(scene);
  Contact contact = closed_between(0, 1);
  const double speed = round_off_speed(contact, dt);
  EXPECT_DOUBLE_EQ(speed, 1e-9 / dt);
  contact.history.normal = 1.01 * 4e3 * speed / dt;
  EXPECT_TRUE(bears(built.stepper->blocks(), contact, dt));
  contact.history.normal = 0.99 * 4e3 * speed / dt;
  EXPECT_FALSE(bears(built.stepper->blocks(), contact, dt));
}

/// The block of 2 m x 1 m is crossed first; through a held one no wave has to go.
TEST(ImpactCriteria, AnImpactTakesAsLongAsWavesThroughTheSmallerBlock) {
  const BlocksOfTwoSizes of_two_sizes;
  const auto of = [&](int a, int b) { return impact_duration(of_two_sizes.blocks, closed_between(a, b)); };
  const double large = transit_time(of_two_sizes.blocks.block(0)),
               small = transit_time(of_two_sizes.blocks.block(1));
  EXPECT_NEAR(large / small, 3 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(of(0, 1), small);
  EXPECT_EQ(of(1, 0), small);
  EXPECT_EQ(of(0, 2), large);
  EXPECT_EQ(of(2, 0), large);
}

/// Tension and cohesion for the duration, and friction of what presses.
TEST(ImpactCriteria, ABondBearsTheImpulsesOfItsStrength) {
  Contact contact;
  contact.law.tension = 300;
  contact.law.cohesion = 200;
  ImpactContact part;
  part.friction = 0.5;
  const auto holds = [&](double normal, double shear) {
    return bond_bears(contact, part, {normal, shear}, 0.1);
  };
  EXPECT_TRUE(holds(-29.9, 19.9) && holds(-29.9, -19.9));
  EXPECT_FALSE(holds(-30.1, 0));
  EXPECT_FALSE(holds(-29.9, 20.1) || holds(-29.9, -20.1));
  EXPECT_TRUE(holds(100, 69.9) && holds(100, -69.9));
  EXPECT_FALSE(holds(100, 70.1) || holds(100, -70.1));
}
