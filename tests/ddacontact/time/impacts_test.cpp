#include <ddacontact/time/impacts.hpp>
#include <tests/ddacontact/time/trial_of.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace support;

namespace {

/// A block of 4 t over a plate, `height` above it, and the impact within a step of 10 ms.
struct FallingBlock {
  TrialOf step;
  StepRule rule;

  FallingBlock(double height, const Vec2& velocity, double restitution, double friction_angle = 0,
               double g = 0)
      : step(scene(height, velocity, restitution, friction_angle, g)) {
    rule.scheme = Scheme::decaying;
    step.detect();
  }
  static Scene scene(double height, const Vec2& velocity, double restitution, double friction_angle,
                     double g) {
    Scene scene = default_mechanics(0.01);
    scene.analysis.gravity = {0, -g};
    scene.joints[0].restitution = restitution;
    scene.joints[0].friction_angle = friction_angle;
    scene.blocks = {block(rectangle(-2, -1, 12, 1), true), block(rectangle(0, height, 2, 1))};
    scene.blocks[1].velocity = velocity;
    return scene;
  }
  StepImpact impact() {
    return predict_impact({step.blocks, step.state, step.properties, step.trial.contacts(), rule, 0.01}, {});
  }
  Vec2 mean(const VectorXd& of_all) const { return step.mean_motion(of_all, 1); }
};

}  // namespace

TEST(Impacts, RestitutionIsTheJointsOrThatOfTheScheme) {
  JointStrength joint;
  const auto of = [&](Scheme scheme) {
    StepRule rule;
    rule.scheme = scheme;
    return restitution_of({1, 1, JointTable(joint), {0, 0}}, {0, 0, 1, 0}, rule);
  };
  EXPECT_FALSE(of(Scheme::decaying) || of(Scheme::central_difference)) << "as their elasticity has it";
  EXPECT_EQ(of(Scheme::midpoint), 0.);
  joint.normal_stiffness = joint.shear_stiffness = 1e9;
  EXPECT_FALSE(of(Scheme::midpoint)) << "the joint's springs do it";
  joint.restitution = 0.4;
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::dda}) EXPECT_EQ(of(scheme), 0.4);
}

/// It meets the plate half way and goes back with `restitution` times its speed.
TEST(Impacts, ABlockThatLandsFlatIsThrownBack) {
  for (const double e : {0., 0.5, 1.}) {
    FallingBlock falls(0.005, {0, -1}, e);
    const StepImpact impact = falls.impact();
    ASSERT_TRUE(impact.changes());
    EXPECT_EQ(impact.n_hits, 2);
    EXPECT_TRUE(impact.settled && !impact.limited);
    EXPECT_LE((falls.mean(impact.jump) - Vec2(0, 1 + e)).norm(), 1e-9);
    EXPECT_LE((falls.mean(impact.shift) - Vec2(0, -(1 + e) * 0.005)).norm(), 1e-9);
    EXPECT_LE((falls.mean(impact.start.going_on()) - Vec2(0, e)).norm(), 1e-9);
    EXPECT_NEAR(impact.normal_loss, 4000 * (1 - e * e) / 2, 1e-6);
    EXPECT_NEAR(impact.friction_loss, 0, 1e-9);
    ASSERT_EQ(impact.acceleration_before.size(), 1u) << "nothing but the block that falls";
    EXPECT_EQ(impact.acceleration_before[0].first, 1);
    EXPECT_TRUE(impact.acceleration_before[0].second.isZero(0)) << "no weight, nothing touches it";
  }
}

/// The bound of the shear impulse is tan(phi) times that of the normal one.
TEST(Impacts, FrictionActsWithinTheImpact) {
  FallingBlock falls(0.005, {1, -1}, 0.5, 10);
  const StepImpact impact = falls.impact();
  const double slower = std::tan(radians(10)) * 1.5;
  EXPECT_LE((falls.mean(impact.jump) - Vec2(-slower, 1.5)).norm(), 1e-9);
  EXPECT_NEAR(impact.friction_loss + impact.normal_loss,
              4000 * (1 + 1 - 0.25 - (1 - slower) * (1 - slower)) / 2, 1e-6);
}

/// Under gravity it comes down faster; what falls later than this step and the way of a wave is left.
TEST(Impacts, TheFallIsFollowedToTheTimeOfTheMeeting) {
  for (const double g : {10., 40.}) {
    FallingBlock falls(0.005, {0, -2}, 1, 0, g);
    const double time = (-2 + std::sqrt(4 + 2 * g * 0.005)) / g, speed = 2 + g * time;
    const StepImpact impact = falls.impact();
    EXPECT_NEAR(falls.mean(impact.jump).y(), 2 * speed, 1e-6);
    VectorXd acceleration = VectorXd::Zero(impact.jump.size());
    for (const auto& [b, of_block] : impact.acceleration_before)
      falls.step.blocks.block(b).unknowns().of(acceleration) = of_block;
    EXPECT_LE((falls.mean(acceleration) - Vec2(0, -g)).norm(), 1e-9);
  }
  EXPECT_FALSE(FallingBlock(0.03, {0, -2}, 1).impact().changes());
  EXPECT_FALSE(FallingBlock(0.005, {0, 2}, 1).impact().changes()) << "it goes away";
}

/// A tenth of what gravity makes in the step, or round-off.
TEST(Impacts, SlowContactsAreNoHits) {
  FallingBlock slow(1e-5, {0, -0.009}, 1, 0, 10), faster(1e-5, {0, -0.011}, 1, 0, 10);
  ASSERT_FALSE(slow.step.trial.contacts().empty());
  const Contact& contact = slow.step.trial.contacts()[0];
  EXPECT_NEAR(least_approach(slow.step.blocks, contact, 0.01), 0.01, 1e-15);
  slow.step.blocks.gravity.setZero();
  EXPECT_NEAR(least_approach(slow.step.blocks, contact, 0.01), 1e-9 * std::sqrt(2) / 0.01, 1e-15);
  faster.step.blocks.gravity = {0, 0};
  EXPECT_TRUE(faster.impact().changes());
}
