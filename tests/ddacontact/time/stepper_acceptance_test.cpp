#include <tests/ddacontact/time/trial_of.hpp>

#include <gtest/gtest.h>

using namespace support;

/// A block that hangs by held vertices carries its weight there, whatever its model and however it is held.
TEST(StepperAcceptance, ReactionsOfHeldVerticesCarryABlock) {
  constexpr double weight = 2 * 2000 * 10;
  for (BlockModel model : {BlockModel::wachspress, BlockModel::affine})
    for (Preset preset : {Preset::standard, Preset::paper}) {
      Scene scene = rock_scene(0.05, 60);
      scene.analysis.mode = Mode::statics;
      scene.analysis.preset = preset;
      scene.blocks = {block(rectangle(0, 0, 2, 1))};
      scene.blocks[0].model = model;
      scene.blocks[0].fixed_vertices = {2, 3};
      const BuiltScene built = run(scene);
      const Points& reactions = built.stepper->reactions();
      EXPECT_NEAR(reactions.row(1).sum(), weight, 1e-6 * weight);
      EXPECT_NEAR(reactions.row(0).sum(), 0, 1e-6 * weight);
      EXPECT_EQ(reactions.col(0).norm() + reactions.col(1).norm(), 0);
      EXPECT_NEAR(reactions(1, 2), weight / 2, 1e-5 * weight);
    }
}

/// Of a pendulum that falls from the horizontal: what its mass needs at the angle and the speed that it has,
/// m (a + g). Forces of the step before would be a step late, 2.6 % in steps of 10 ms.
TEST(StepperAcceptance, ReactionsAreThoseAtTheTimeOfTheState) {
  constexpr double mass = 2 * 2000, g = 10, inertia = mass * (4 + 1) / 12;
  std::vector<double> errors;
  for (const double dt : {0.01, 0.005}) {
    Scene scene = default_mechanics(dt);
    scene.analysis.steps = static_cast<int>(std::lround(0.5 / dt));
    scene.blocks = {block(rectangle(0, 0, 2, 1))};
    scene.blocks[0].fixed_vertices = {3};
    const BuiltScene built = run(scene);
    const BlockState& state = built.stepper->state();
    const Block& of = built.stepper->blocks().block(0);
    const double w = rigid_velocity(of, state, state.velocity).angular;
    const Vec2 r = of.centroid(state) - Vec2(0, 1);
    const double turning = -mass * g * r.x() / (inertia + mass * r.squaredNorm());
    const Vec2 acceleration = turning * Vec2(-r.y(), r.x()) - w * w * r;
    const Vec2 expected = mass * (acceleration + Vec2(0, g));
    errors.push_back((built.stepper->reactions().col(3) - expected).norm() / expected.norm());
  }
  EXPECT_LE(errors[0], 3e-4);
  EXPECT_LE(errors[1], errors[0] / 3.5);
}

/// With half steps the velocity in the middle of the next step is looked for: that now lies between both.
TEST(StepperAcceptance, TheVelocityOfTheStateIsThatAtItsTime) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint}) {
    Scene scene = default_mechanics(0.02, scheme);
    scene.analysis.steps = 3;
    scene.blocks = {block(rectangle(0, 0, 1, 1))};
    const BuiltScene built = run(scene);
    const RigidVelocity now = rigid_velocity(built.stepper->blocks().block(0), built.stepper->state(),
                                             built.stepper->state().velocity);
    EXPECT_NEAR(now.linear.y(), -10 * 0.06, 1e-9);
    const RigidVelocity before = rigid_velocity(built.stepper->blocks().block(0), built.stepper->state(),
                                                built.stepper->state().going_on());
    EXPECT_NEAR(before.linear.y(), scheme == Scheme::decaying ? -0.5 : -0.6, 1e-9);
    EXPECT_NEAR(built.stepper->energy().now.kinetic, 2000 * 0.6 * 0.6 / 2, 1e-6);
    EXPECT_EQ(built.stepper->counts().unknown_velocities, 0);
    EXPECT_EQ(built.stepper->last_dt(), 0.02);
  }
}

/// What comes of an impact in the next step, the weight that the ground bears from then on included, is not
/// yet there at the present time.
TEST(StepperAcceptance, AnImpactToComeIsNotInTheVelocity) {
  for (const double restitution : {0., 0.5}) {
    Scene scene = default_mechanics(0.02);
    scene.analysis.steps = 3;
    scene.joints[0].restitution = restitution;
    constexpr double at_impact = 0.07;
    scene.blocks = {block(rectangle(-1, -1, 3, 1), true),
                    block(rectangle(0, 5 * at_impact * at_impact, 1, 1))};
    const BuiltScene built = run(scene);
    EXPECT_EQ(built.stepper->counts().impacts, 0);
    const auto velocity = [&] {
      return rigid_velocity(built.stepper->blocks().block(1), built.stepper->state(),
                            built.stepper->state().velocity)
          .linear;
    };
    EXPECT_LE((velocity() - Vec2(0, -10 * 0.06)).norm(), 1e-9);
    ASSERT_TRUE(built.stepper->step());
    EXPECT_GT(built.stepper->counts().impacts, 0);
    EXPECT_GT(velocity().y(), -0.01);
  }
}

/// A ringing block of incremental kinematics: its mass follows its shape, its momentum does not.
TEST(StepperAcceptance, AChangeOfShapeLeavesTheMomentum) {
  for (const Preset preset : {Preset::standard, Preset::paper}) {
    Scene scene = rock_scene(1e-3, 30);
    scene.analysis.preset = preset;
    scene.analysis.gravity.setZero();
    scene.materials[0].young = 1e7;
    Points outline(2, 4);
    outline << 0, 3, 2, 0, 0, 0, 1, 2;
    scene.blocks = {block(outline)};
    scene.blocks[0].stress = {2e6, 0, 1e6};
    scene.blocks[0].velocity = {3, 1};
    const BuiltScene built = build(scene);
    const Vec2 start = momentum(*built.stepper, 0);
    run(*built.stepper, 30);
    const double lost = (momentum(*built.stepper, 0) - start).norm() / start.norm();
    EXPECT_EQ(lost > 1e-9, preset == Preset::paper) << lost;
  }
}

TEST(StepperAcceptance, CountsWhatItHasMade) {
  Scene scene = default_mechanics(0.01);
  scene.analysis.steps = 4;
  scene.blocks = {block(rectangle(-2, -1, 12, 1), true), block(rectangle(0, 0, 2, 1)),
                  block(rectangle(4, 0.01, 2, 1))};
  scene.blocks[2].velocity = {0, -2};
  scene.joints[0].restitution = 1;
  BuiltScene built = build(scene);
  run(*built.stepper, 1);
  EXPECT_EQ(built.stepper->counts().impacts, 2) << "both corners";
  run(*built.stepper, 3);
  const StepCounts& counts = built.stepper->counts();
  EXPECT_EQ(counts.steps, 4);
  EXPECT_EQ(counts.substeps, 4);
  EXPECT_EQ(counts.contacts, 2);
  EXPECT_GE(counts.contacts_max, 2);
  EXPECT_EQ(counts.equations, built.stepper->blocks().n_equations());
  EXPECT_LE(counts.max_residual, counts.largest_tolerance);
}

/// Its corner is led into it by a support; that it is concave is told once.
TEST(StepperAcceptance, NotesABlockThatTurnsConcave) {
  Scene scene = default_mechanics(0.1, Scheme::midpoint);
  scene.analysis.steps = 6;
  scene.analysis.gravity.setZero();
  scene.analysis.max_displacement_ratio = 1;
  scene.blocks = {block(rectangle(0, 0, 1, 1))};
  scene.supports = {{0, {0, 1, 3}, true, true, {}},
                    {0, {2}, true, true, {TimeFunction::Kind::rate, {-1, -1}, {}}}};
  const BuiltScene built = run(scene);
  ASSERT_EQ(built.stepper->notes().size(), 1u);
  EXPECT_NE(built.stepper->notes()[0].find("is no longer convex at time 0.5"), std::string::npos)
      << built.stepper->notes()[0];
}
