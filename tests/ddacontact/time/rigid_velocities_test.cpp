#include <tests/ddacontact/time/touching_blocks.hpp>

#include <gtest/gtest.h>

#include <random>

using namespace support;

class Restitution : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Range, Restitution, testing::Values(0., 0.5, 0.8, 1.));

TEST_P(Restitution, OfABlockThatFallsFlatIsThatOfItsVelocity) {
  const double e = GetParam();
  for (BlockModel model : {BlockModel::wachspress, BlockModel::affine}) {
    BlockDescription brick = block(rectangle(0, 0, 2, 1));
    brick.model = model;
    TouchingBlocks hit({floor_block, brick}, 0.5, e);
    ASSERT_EQ(hit.contacts.size(), 2u);
    hit.set_velocity(1, {0, -3, 0});
    const JumpReport report = hit.jump();
    hit.check(report, 1e-9);
    EXPECT_TRUE(report.settled);
    EXPECT_FALSE(report.limited);
    for (const ImpactContact& contact : hit.contacts)
      EXPECT_NEAR(contact.gap.change(hit.v + report.jump), 3 * e, 3e-9);
    EXPECT_NEAR(report.impulses[0].normal + report.impulses[1].normal, (1 + e) * 3 * 4000, 1e-5);
    EXPECT_NEAR(report.normal_loss, (1 - e * e) * 9 * 2000, 1e-5);
  }
}

TEST_P(Restitution, OfACornerTurnsTheBlock) {
  const double e = GetParam();
  for (double angle : {0.1, 0.4, 0.7}) {
    Points brick = turned(rectangle(0, 0, 2, 1), angle);
    TouchingBlocks hit({floor_block, block(brick)}, 0, e);
    ASSERT_EQ(hit.contacts.size(), 1u);
    hit.set_velocity(1, {1, -3, 0.5});
    const double r = hit.vertex(1, 0).x() - hit.centroid(1).x(), m = 4000, u = -3 + 0.5 * r;

    const double P = -(1 + e) * u / (1 / m + r * r / hit.inertia(1));
    const JumpReport report = hit.jump();
    hit.check(report, 1e-9);
    const RigidVelocity after = hit.velocity(1, hit.v + report.jump);
    EXPECT_NEAR(report.impulses[0].normal, P, 1e-9 * P);
    EXPECT_NEAR(after.linear.x(), 1, 1e-12);
    EXPECT_NEAR(after.linear.y(), -3 + P / m, 1e-9);
    EXPECT_NEAR(after.angular, 0.5 + r * P / hit.inertia(1), 1e-9);
  }
}

/// A square on its corner: normal and shear know nothing of each other.
TEST_P(Restitution, SlidesOrSticksUnderFriction) {
  const double e = GetParam(), h = std::sqrt(0.5), m = 2000, speed = 2;
  for (double friction : {0.05, 0.1, 0.3, 1.}) {
    TouchingBlocks hit({floor_block, block(turned(rectangle(0, 0, 1, 1), radians(45)))}, friction, e);
    ASSERT_EQ(hit.contacts.size(), 1u);
    hit.set_velocity(1, {speed, -3, 0});
    const double to_stick = speed / (1 / m + h * h / hit.inertia(1));
    const double T = std::min(to_stick, friction * (1 + e) * 3 * m);
    const JumpReport report = hit.jump();
    hit.check(report, 1e-9);
    const RigidVelocity after = hit.velocity(1, hit.v + report.jump);
    EXPECT_NEAR(after.linear.y(), 3 * e, 1e-9);
    EXPECT_NEAR(after.linear.x(), speed - T / m, 1e-9) << friction;
    EXPECT_NEAR(after.angular, -h * T / hit.inertia(1), 1e-9);
  }
}

/// The bound of a law of one's own, here one that friction does not exceed.
TEST_P(Restitution, SlidesUnderAFrictionLawOfOnesOwn) {
  const double e = GetParam(), h = std::sqrt(0.5), m = 2000, most = 700;
  TouchingBlocks hit({floor_block, block(turned(rectangle(0, 0, 1, 1), radians(45)))}, 0, e);
  ASSERT_EQ(hit.contacts.size(), 1u);
  hit.contacts[0].friction_law = [&](double normal) { return std::min(0.3 * normal, most); };
  hit.set_velocity(1, {2, -3, 0});
  const JumpReport report = hit.jump();
  ASSERT_TRUE(report.settled);
  EXPECT_LE(hit.energy(hit.v + report.jump), hit.energy(hit.v));
  const RigidVelocity after = hit.velocity(1, hit.v + report.jump);
  EXPECT_NEAR(after.linear.y(), 3 * e, 1e-9);
  EXPECT_NEAR(after.linear.x(), 2 - most / m, 1e-9);
  EXPECT_NEAR(after.angular, -h * most / hit.inertia(1), 1e-9);
}

TEST_P(Restitution, OfTwoBlocksKeepsTheirMomentum) {
  const double e = GetParam();
  for (double offset : {0., 0.3, -0.6})
    for (double friction : {0., 0.4}) {
      TouchingBlocks hit({block(rectangle(-1, 0, 1, 1)), block(rectangle(0, offset, 1, 1))}, friction, e);
      ASSERT_GE(hit.contacts.size(), 2u);
      hit.set_velocity(0, {4, 0.5, 0});
      hit.set_velocity(1, {-1, 0, 0});
      const JumpReport report = hit.jump();
      hit.check(report, 1e-9);
      const VectorXd after = hit.v + report.jump;
      EXPECT_LE((hit.momentum(after) - hit.momentum(hit.v)).norm(), 1e-14 * 2000 * 5 * 4);
      if (offset != 0 || friction != 0) continue;
      EXPECT_NEAR(hit.velocity(0, after).linear.x(), 1.5 - 2.5 * e, 1e-9);
      EXPECT_NEAR(hit.velocity(1, after).linear.x(), 1.5 + 2.5 * e, 1e-9);
    }
}

/// A pendulum turns about the vertex that holds it.
TEST_P(Restitution, OfABlockHeldAtAVertexTurnsItAboutThatVertex) {
  const double e = GetParam();
  BlockDescription pendulum = block(rectangle(0, 0, 1, 2));
  pendulum.fixed_vertices = {3};  // (0, 2)
  TouchingBlocks hit({block(rectangle(-1, 0.2, 1, 0.4)), pendulum}, 0, e);
  ASSERT_EQ(hit.contacts.size(), 2u);
  hit.set_velocity(0, {3, 0, 0});
  const JumpReport report = hit.jump();
  hit.check(report, 1e-9);
  const VectorXd after = hit.v + report.jump;
  const RigidVelocity turning = hit.velocity(1, after);
  const Vec2 arm = hit.centroid(1) - hit.vertex(1, 3);
  EXPECT_LE((turning.linear - turning.angular * Vec2(-arm.y(), arm.x())).norm(), 1e-12);
  for (const PrescribedDof& held : hit.blocks.prescribed_dofs()) EXPECT_EQ(report.jump[held.unknown], 0);
  double normal = 0, moment = 0;
  for (std::size_t c = 0; c < 2; ++c) normal += report.impulses[c].normal;
  const double about_pin = hit.inertia(1) + 4000 * arm.squaredNorm();
  moment = turning.angular * about_pin;
  EXPECT_GT(moment, 1.4 * normal * (1 - 1e-9));  // the impulses pass between 1.4 and 1.8 below the pin
  EXPECT_LT(moment, 1.8 * normal * (1 + 1e-9));
  EXPECT_NEAR(hit.velocity(0, after).linear.x(), 3 - normal / 800, 1e-9);
}

/// A floor that rises throws up what rests on it; the energy is that of whatever moves the floor.
TEST_P(Restitution, OfASupportThatMovesThrowsABlockUp) {
  const double e = GetParam();
  TouchingBlocks hit({floor_block, block(rectangle(0, 0, 1, 1))}, 0.5, e);
  hit.set_velocity(0, {0, 2, 0});
  const JumpReport report = hit.jump();
  EXPECT_TRUE(report.settled);
  EXPECT_FALSE(report.limited);
  EXPECT_NEAR(hit.velocity(1, hit.v + report.jump).linear.y(), 2 * (1 + e), 1e-9);
  EXPECT_NEAR(report.normal_loss, (1 - e * e) * 2000 * 4 / 2, 1e-5);
}

/// Impulses through its pin do not move a pendulum, nor any a block held at two vertices.
TEST(RigidVelocities, WhatNoImpulseCanMoveTakesNone) {
  for (const std::vector<int>& held : {std::vector<int>{0}, std::vector<int>{0, 1}}) {
    BlockDescription pendulum = block(rectangle(0, 0, 1, 1));
    pendulum.fixed_vertices = held;
    TouchingBlocks hit({floor_block, pendulum, block(rectangle(0.2, 1, 0.6, 1))});
    hit.set_velocity(2, {0, -1, 0});
    if (held.size() == 2) hit.set_velocity(0, {0, 0.1, 0});
    const JumpReport report = hit.jump();
    EXPECT_TRUE(report.settled);
    for (int b : {1, 2}) {
      const RigidVelocity after = hit.velocity(b, hit.v + report.jump);
      EXPECT_LE(after.linear.norm() + std::abs(after.angular), 1e-9);
    }
    EXPECT_EQ(report.impulses[0].normal, 0);  // of the pin on the floor
    for (const PrescribedDof& of : hit.blocks.prescribed_dofs()) EXPECT_EQ(report.jump[of.unknown], 0);
  }
}

TEST(RigidVelocities, AStackHitAtItsEndMovesOnAsOne) {
  std::vector<BlockDescription> blocks;
  for (int b = 0; b < 21; ++b) blocks.push_back(block(rectangle(0, b, 2, 1)));
  TouchingBlocks hit(blocks, 0.3);
  hit.set_velocity(20, {0, -21, 0});
  const JumpReport report = hit.jump();
  hit.check(report, 1e-9);
  EXPECT_TRUE(report.settled);
  for (int b = 0; b < 21; ++b) {
    const RigidVelocity after = hit.velocity(b, hit.v + report.jump);
    EXPECT_LE((after.linear - Vec2(0, -1)).norm(), 1e-8);
    EXPECT_NEAR(after.angular, 0, 1e-8);
  }
}

TEST(RigidVelocities, AWallOfBricksStopsWhatFallsOnIt) {
  std::vector<BlockDescription> blocks = wall(4, 5);
  blocks.push_back(block(rectangle(3, 4, 3, 3)));
  TouchingBlocks hit(blocks, 0.6);
  hit.set_velocity(hit.blocks.n_blocks() - 1, {0.5, -5, 0});
  const JumpReport report = hit.jump();
  hit.check(report, 1e-9);
  EXPECT_TRUE(report.settled);
}

TEST(RigidVelocities, MassRatiosOfAMillionAreSolvedToTheSameTolerance) {
  for (double ratio : {1e-6, 1e6})
    for (double e : {0., 1.}) {
      std::vector<BlockDescription> blocks{floor_block, of_material(0, block(rectangle(0, 0, 2, 1))),
                                           of_material(1, block(rectangle(0, 1, 2, 1))),
                                           of_material(0, block(rectangle(0, 2, 2, 1)))};
      TouchingBlocks hit(blocks, 0.3, e, {2000, 2000 * ratio});
      hit.set_velocity(2, {0, -1, 0});
      hit.set_velocity(3, {0, -1, 0});
      const JumpReport report = hit.jump();
      hit.check(report, 1e-8);
      EXPECT_TRUE(report.settled);
    }
}

TEST(RigidVelocities, KineticEnergyNeverRises) {
  std::mt19937 random(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  int unsettled = 0, limited = 0;
  for (int scene = 0; scene < 10; ++scene) {
    TouchingBlocks hit(wall(1 + scene % 2, 2 + scene % 3), 0, 0, {500, 2000, 20000});
    for (int trial = 0; trial < 100; ++trial) {
      for (int b = 1; b < hit.blocks.n_blocks(); ++b)
        hit.set_velocity(b, {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
      const double e = uniform(0, 1), friction = uniform(0, 1.5);
      for (ImpactContact& contact : hit.contacts) {
        contact.friction = trial % 3 ? friction : uniform(0, 1.5);
        contact.restitution = trial % 2 ? e : uniform(0, 1);
        contact.bonded = uniform(0, 1) < 0.05;
      }
      const JumpReport report = hit.jump();
      hit.check(report, 1e-7);
      unsettled += !report.settled;
      limited += report.limited;
    }
  }
  EXPECT_LE(unsettled, 12);
  EXPECT_EQ(limited, 0);
}

/// Coulomb's law, contact by contact, of an impact without restitution.
TEST(RigidVelocities, EveryContactOpensSticksOrSlidesAgainstItsFriction) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  TouchingBlocks hit(wall(2, 3), 0.4);
  int sliding = 0, sticking = 0, open = 0;
  for (int trial = 0; trial < 50; ++trial) {
    for (int b = 1; b < hit.blocks.n_blocks(); ++b)
      hit.set_velocity(b, {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
    const JumpReport report = hit.jump();
    if (!report.settled) continue;
    const VectorXd after = hit.v + report.jump;
    for (std::size_t c = 0; c < hit.contacts.size(); ++c) {
      const auto [N, T] = report.impulses[c];
      const double gap_rate = hit.contacts[c].gap.change(after),
                   slip_rate = hit.contacts[c].slip.change(after);
      EXPECT_GE(gap_rate, -1e-7);
      if (N > 1e-4) {
        EXPECT_NEAR(gap_rate, 0, 1e-7);
      } else {
        ++open;
        continue;
      }
      if (std::abs(slip_rate) > 1e-6) {
        EXPECT_NEAR(T, -std::copysign(0.4 * N, slip_rate), 1e-4);
        ++sliding;
      } else {
        ++sticking;
      }
    }
  }
  EXPECT_GT(sliding, 50);
  EXPECT_GT(sticking, 50);
  EXPECT_GT(open, 50);
}

TEST(RigidVelocities, BondedBlocksMoveOnAsOneBody) {
  TouchingBlocks hit(
      {block(rectangle(0, 0, 1, 1)), block(rectangle(1, 0, 1, 1)), block(rectangle(0.2, 1, 0.6, 0.6))});
  for (ImpactContact& contact : hit.contacts) contact.bonded = true;
  for (std::size_t c = 0; c < hit.contacts.size(); ++c)
    for (int u : hit.contacts[c].gap.unknowns())
      if (u >= hit.blocks.block(2).unknowns().first) hit.contacts[c].bonded = false;
  hit.set_velocity(1, {-1, 0, 0});
  EXPECT_EQ(hit.jump().jump.norm(), 0) << "bonded blocks cannot collide";
  hit.set_velocity(1, {0, 0, 0});
  hit.set_velocity(2, {0, -2, 0});
  const JumpReport report = hit.jump();
  hit.check(report, 1e-9);
  const VectorXd after = hit.v + report.jump;
  const RigidVelocity left = hit.velocity(0, after), right = hit.velocity(1, after);
  EXPECT_NEAR(left.angular, right.angular, 1e-9);
  EXPECT_LE((right.linear - left.linear - left.angular * Vec2(0, 1)).norm(), 1e-9);
  EXPECT_GT(left.angular, 0.1);
  EXPECT_LE((hit.momentum(after) - hit.momentum(hit.v)).norm(), 1e-12 * 2000);
}

/// A block that only swells into the floor must not be thrown up by it.
TEST(RigidVelocities, RatesOfDeformationMakeNoRigidEnergy) {
  for (double e : {0., 1.}) {
    TouchingBlocks hit({floor_block, block(rectangle(0, 0, 1, 1))}, 0, e);
    const Range& u = hit.blocks.block(1).unknowns();
    for (int k = 0; k < 4; ++k) hit.v.segment(u.first + 2 * k, 2) = hit.vertex(1, k) - hit.centroid(1);
    const VectorXd swelling = hit.v;
    EXPECT_LE(hit.energy(hit.v + hit.jump().jump), hit.energy(hit.v) * (1 + 1e-12));
    EXPECT_TRUE(hit.jump().limited);
    hit.set_velocity(1, {0, -3, 0});
    hit.v += swelling;
    const JumpReport report = hit.jump();
    EXPECT_LE(hit.energy(hit.v + report.jump), hit.energy(hit.v) * (1 + 1e-12));
    EXPECT_EQ(report.limited, e == 1);
    if (e == 1) {
      EXPECT_NEAR(hit.energy(hit.v + report.jump), hit.energy(hit.v), 1e-9 * hit.energy(hit.v));
    }
    if (e == 0) {
      EXPECT_NEAR(hit.contacts[0].gap.change(hit.v + report.jump), 0, 1e-9);
    }
  }
}

TEST(RigidVelocities, OnlyIslandsThatAreHitTakePart) {
  TouchingBlocks hit({floor_block, block(rectangle(0, 0, 1, 1)), block(rectangle(0, 1, 1, 1)),
                      block(rectangle(9, 0, 1, 1))});
  hit.set_velocity(2, {0, -1, 0});
  hit.set_velocity(3, {0, -1e-3, 0.1});
  const JumpReport report = hit.jump(0.5);
  const Range& u = hit.blocks.block(3).unknowns();
  EXPECT_EQ(report.jump.segment(u.first, u.count).norm(), 0);
  EXPECT_NEAR(hit.velocity(2, hit.v + report.jump).linear.y(), 0, 1e-9);
  EXPECT_EQ(hit.jump(2).jump.norm(), 0);
}
