/// \file Blocks in flight against the parabola and the turn of a rigid body, and when what approaches
/// touches.
#include <ddacontact/block/motion_shape.hpp>
#include <ddacontact/time/free_flight.hpp>
#include <tests/ddacontact/time/trial_of.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace support;

namespace {

/// Three blocks in the air and a held one, all with a velocity of their deformation too.
struct Flying {
  BuiltScene built = build(scene());
  const BlockSystem& blocks = built.stepper->blocks();
  BlockState state = built.stepper->state();
  VectorXd velocity = VectorXd::Zero(blocks.n_unknowns()), acceleration = velocity;

  static Scene scene() {
    Scene scene = default_mechanics(0.01);
    scene.blocks = {block(rectangle(0, 0, 2, 1)), block(turned(rectangle(5, 0, 1, 1), 0.3)),
                    block(rectangle(-9, -9, 1, 1), true), block(rectangle(0, 7, 1, 3))};
    return scene;
  }
  void set(VectorXd& of_all, int b, const RigidVelocity& rigid) const {
    blocks.block(b).unknowns().of(of_all) = as_velocity(blocks.block(b), state, rigid);
  }
  Vec2 centre(const BlockState& of, int b) const { return blocks.block(b).centroid(of); }
};

}  // namespace

TEST(FreeFlight, AGapIsClosedWhereItsParabolaFirstIsZero) {
  EXPECT_EQ(first_touch(1, -2, 0, 1), 0.5);
  EXPECT_NEAR(first_touch(1, 0, -2, 2), 1, 1e-15);
  EXPECT_EQ(first_touch(1, -0.5, 0, 1), inf) << "later";
  EXPECT_EQ(first_touch(1, -1, 1, 9), inf) << "turns round before";
  EXPECT_EQ(first_touch(0, -1, 0, 1), 0);
  EXPECT_EQ(first_touch(0, 1, 0, 1), inf);
}

TEST(FreeFlight, BeforeItsFirstTouchAGapIsOpen) {
  std::mt19937 random(1);
  int n_touch = 0;
  for (int k = 0; k < 1000; ++k) {
    const double g = uniform(0, 1, random), v = uniform(-3, 3, random), a = uniform(-3, 3, random),
                 t = first_touch(g, v, a, 2);
    const auto gap = [&](double at) { return g + v * at + a * at * at / 2; };
    for (int part = 0; part < 100; ++part) EXPECT_GT(gap(0.01 * part * std::min(t, 2.0)), -1e-12);
    if (t == inf) continue;
    EXPECT_NEAR(gap(t), 0, 1e-12);
    ++n_touch;
  }
  EXPECT_GT(n_touch, 300);
}

/// A circle of 3 m that passes the corner in a straight line 5 m away at first.
TEST(FreeFlight, ACircleTouchesACornerAtItsRadius) {
  EXPECT_NEAR(first_touch({5, 0}, {-2, 0}, 3, 9), 1, 1e-15);
  EXPECT_EQ(first_touch({5, 0}, {-2, 0}, 3, 0.9), inf) << "later";
  EXPECT_EQ(first_touch({5, 0}, {2, 0}, 3, 9), inf) << "goes away";
  EXPECT_EQ(first_touch({5, 3.1}, {-2, 0}, 3, 9), inf) << "passes";
  EXPECT_EQ(first_touch({2, 0}, {-1, 0}, 3, 9), 0) << "overlaps";
  std::mt19937 random(2);
  for (int k = 0; k < 300; ++k) {
    const Vec2 apart = 2 * random_direction(random), velocity = random_direction(random);
    const double t = first_touch(apart, velocity, 1.5, 9);
    if (t < inf)
      EXPECT_NEAR((apart + t * velocity).norm(), 1.5, 1e-12);
    else
      EXPECT_TRUE(apart.dot(velocity) >= 0 || std::abs(cross(apart, velocity)) >= 1.5);
  }
}

TEST(FreeFlight, PointsLeaveTheirStraightLinesAsTheirBlockTurns) {
  const Vec2 off = off_straight_line({2, 0}, 0.3);
  EXPECT_NEAR(off.x(), 2 * (std::cos(0.3) - 1), 1e-15);
  EXPECT_NEAR(off.y(), 2 * (std::sin(0.3) - 0.3), 1e-15);
}

/// Centres go along their parabolas, blocks turn about them and keep their shapes; those that are held, or
/// have no time, stay.
TEST(FreeFlight, BlocksAreCarriedOnAsRigidBodies) {
  Flying flying;
  const RigidVelocity v{{3, -1}, 2}, a{{-1, -10}, -4};
  for (int b = 0; b < 4; ++b) {
    flying.set(flying.velocity, b, v);
    flying.set(flying.acceleration, b, a);
  }
  const double t = 0.4, angle = 2 * t - 4 * t * t / 2;
  flying.blocks.find_coordinates(flying.state);
  const BlockState later =
      carried(flying.blocks, flying.state, flying.velocity, flying.acceleration, {t, t / 2, t, inf});
  EXPECT_LE(
      (flying.centre(later, 0) - flying.centre(flying.state, 0) - Vec2(3 * t - t * t / 2, -t - 5 * t * t))
          .norm(),
      1e-13);
  const Points before = flying.blocks.block(0).outline(flying.state),
               after = flying.blocks.block(0).outline(later);
  for (int k = 0; k < 4; ++k) {
    const Vec2 was = before.col((k + 1) % 4) - before.col(k), is = after.col((k + 1) % 4) - after.col(k);
    EXPECT_LE((is - Eigen::Rotation2Dd(angle) * was).norm(), 1e-13);
  }
  EXPECT_NEAR(flying.centre(later, 1).x() - flying.centre(flying.state, 1).x(), 1.5 * t - t * t / 8, 1e-13);
  for (const int b : {2, 3})
    EXPECT_EQ(flying.blocks.block(b).outline(later), flying.blocks.block(b).outline(flying.state));
  // The coordinates of their motions are those of the points.
  BlockState found = later;
  flying.blocks.find_coordinates(found);
  ASSERT_GT(later.coordinates.size(), 0);
  EXPECT_LE((found.coordinates - later.coordinates).norm(), 1e-12);
}

/// Its momentum and its energy stay, its angular velocity and what deforms it turn with it.
TEST(FreeFlight, VelocitiesTurnAboutThatOfTheCentre) {
  const Flying flying;
  const Block& block = flying.blocks.block(1);
  VectorXd velocity = VectorXd::Random(flying.blocks.n_unknowns());
  const VectorXd before = velocity;
  const auto of = [&](const VectorXd& all) { return rigid_velocity(block, flying.state, all); };
  turn_about_centre(block, flying.state, turned_by(0.7), velocity);
  EXPECT_LE((of(velocity).linear - of(before).linear).norm(), 1e-13);
  EXPECT_NEAR(block.kinetic_energy(block.unknowns().of(velocity)),
              block.kinetic_energy(block.unknowns().of(before)), 1e-9);
  for (int k = 0; k < 4; ++k) {
    const PointMap u = block.vertex_map(k);
    EXPECT_LE((u(velocity) - of(before).linear - turned_by(0.7) * (u(before) - of(before).linear)).norm(),
              1e-13);
  }
  for (const int b : {0, 2, 3}) {
    const Range& u = flying.blocks.block(b).unknowns();
    EXPECT_EQ(u.of(velocity), u.of(before)) << "it is another block's";
  }
}

TEST(FreeFlight, RigidVelocitiesAreThoseOfEveryBlock) {
  Flying flying;
  for (int b = 0; b < 4; ++b) flying.set(flying.velocity, b, {{b + 1.0, -b}, 0.5 * b});
  const std::vector<RigidVelocity> of_blocks = rigid_velocities(flying.blocks, flying.state, flying.velocity);
  ASSERT_EQ(of_blocks.size(), 4u);
  for (int b = 0; b < 4; ++b) {
    EXPECT_LE((of_blocks[b].linear - Vec2(b + 1.0, -b)).norm(), 1e-13);
    EXPECT_NEAR(of_blocks[b].angular, 0.5 * b, 1e-13);
  }
}
