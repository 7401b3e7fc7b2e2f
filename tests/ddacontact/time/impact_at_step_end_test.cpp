// Impacts where a step ends just as blocks touch, or just as a corner is at a joint: none that is not there, and each
// that is.
#include <ddacontact/block/rigid_velocity.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace ddacontact;
using namespace support;

namespace {

/// Granite without friction, gravity 9.81 m/s2.
Scene granite(double time_step, Scheme scheme) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.scheme = scheme;
  scene.analysis.gravity = {0, -9.81};
  scene.materials = {{"rock", 2500, 3e10, 0.2}};
  scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 1.2e12;
  scene.contact.tangential_stiffness = 4.8e11;
  return scene;
}

/// A slider without friction over two bricks on a bed, of which the first moves, with its front `before` their joint.
Scene slider_over_joint(Scene scene, double before, double speed) {
  const std::optional<double> restitution = scene.joints[0].restitution;
  scene.materials.push_back({"slider", 2500, 3e10, 0.2});
  scene.joints = {{"rough", 60, 0, 0, std::nullopt}, {"smooth", 0, 0, 0, std::array{1, 0}}};
  for (Joint& joint : scene.joints) joint.restitution = restitution;
  scene.blocks = {block(rectangle(-3, -2, 6, 1), true), block(rectangle(-1, -1, 1, 1)),
                  block(rectangle(0, -1, 1, 1), true), block(rectangle(-before - 0.8, 0, 0.8, 0.5))};
  scene.blocks[0].model = BlockModel::affine;
  scene.blocks[3].material = 1;
  scene.blocks[3].velocity = {speed, 0};
  return scene;
}

RigidVelocity after(const Scene& scene, int block, int steps) {
  const BuiltScene built = build(scene);
  const Stepper& stepper = *built.stepper;
  for (int k = 0; k < steps; ++k) EXPECT_TRUE(built.stepper->step()) << stepper.stop_reason();
  return rigid_velocity(stepper.blocks().block(block), stepper.state(), stepper.state().velocity);
}

}  // namespace

TEST(ImpactAtStepEnd, ASliderPassesAFlushJoint) {
  for (const double past : {0., 1e-9, 1e-7}) {
    const Scene whole_steps = granite(0.01, Scheme::midpoint);
    EXPECT_NEAR(after(slider_over_joint(whole_steps, 0.05 + past, 0.5), 3, 15).linear.x(), 0.5, 1e-4) << past;
    Scene bouncing = granite(1e-3, Scheme::decaying);
    bouncing.joints[0].restitution = 0.5;
    const RigidVelocity v = after(slider_over_joint(bouncing, 0.3 + past, 5), 3, 90);
    EXPECT_NEAR(v.linear.x(), 5, 1e-3) << past;
    EXPECT_NEAR(v.linear.y(), 0, 1e-3) << past;
  }
}

/// The same height of a step that is no flush joint stops it.
TEST(ImpactAtStepEnd, AStepHigherThanTheLipStopsASlider) {
  Scene scene = slider_over_joint(granite(0.01, Scheme::midpoint), 0.05, 0.5);
  scene.blocks[2].vertices = rectangle(0, -1, 1, 1.001);
  EXPECT_LT(after(scene, 3, 15).linear.x(), 0.25);
}

TEST(ImpactAtStepEnd, RestitutionIsTheJointsWhereASubstepEndsAtTheWall) {
  for (const Scheme scheme : {Scheme::central_difference, Scheme::decaying, Scheme::midpoint})
    for (const double restitution : {0., 0.5, 0.8})
      for (const double past : {0., 1e-9}) {
        Scene scene = granite(2e-3, scheme);
        scene.joints[0].restitution = restitution;
        scene.blocks = {block(rectangle(-3, -1, 8, 1), true), block(rectangle(0.2 + past, 0, 1, 0.5), true),
                        block(rectangle(-1, 0, 1, 0.5))};
        scene.blocks[0].model = BlockModel::affine;
        scene.blocks[2].velocity = {5, 0};
        EXPECT_NEAR(after(scene, 2, 32).linear.x(), -5 * restitution, 1e-3) << restitution << ' ' << past;
      }
}

/// From 40 to 30 degrees without friction: when the rear end is at the bend, both ends bear and the block turns no
/// more.
TEST(ImpactAtStepEnd, ABlockThatLandsFlushBehindABendTurnsNoMore) {
  const auto along = [](double degrees) {
    return Vec2(std::cos(radians(degrees)), -std::sin(radians(degrees)));
  };
  const auto across = [](double degrees) {
    return Vec2(std::sin(radians(degrees)), std::cos(radians(degrees)));
  };
  const Vec2 upper = -3 * along(40), lower = 3 * along(30);
  const Vec2 under = -across(35) / std::cos(radians(5)), rear = upper, front = rear + 2 * along(40);
  for (double time_step = 1e-3; time_step < 5e-3; time_step += 1e-4) {
    Scene scene = granite(time_step, Scheme::midpoint);
    scene.joints[0].restitution = 0;
    const auto quad = [](const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
      Points outline(2, 4);
      outline << a, b, c, d;
      return outline;
    };
    scene.blocks = {block(quad(upper, upper - across(40), under, Vec2(0, 0)), true),
                    block(quad(Vec2(0, 0), under, lower - across(30), lower), true),
                    block(quad(rear, front, front + 0.8 * across(40), rear + 0.8 * across(40)))};
    scene.blocks[2].velocity = 3 * along(40);
    EXPECT_NEAR(after(scene, 2, static_cast<int>(std::lround(0.62 / time_step))).angular, 0, 1e-3)
        << time_step;
  }
}
