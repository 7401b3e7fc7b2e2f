// What joints with a stiffness of their own store, and where it goes.
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

/// A block of 1 m, without weight, on a fixed one.
Scene stiff_joint(Scheme scheme, double time_step, int steps) {
  Scene scene = rock_scene(time_step, steps);
  scene.analysis.gravity.setZero();
  scene = default_mechanics(scene, scheme);
  scene.materials[0].young = 3e10;
  scene.joints[0].friction_angle = 30;
  scene.joints[0].normal_stiffness = 1e10;
  scene.joints[0].shear_stiffness = 5e9;
  scene.blocks = {block(rectangle(-1, -1, 3, 1), true), block(rectangle(0, 0, 1, 1))};
  for (BlockDescription& of : scene.blocks) of.model = BlockModel::affine;
  return scene;
}

TimeFunction history(std::vector<Vec3> entries) {
  return {TimeFunction::Kind::history, {0, 0}, std::move(entries)};
}

}  // namespace

/// Pushed over until its bonds break, one after the other: what their springs stored in shear is booked too.
TEST(JointEnergy, TheLedgerClosesWhereBondsBreak) {
  for (const Scheme scheme :
       {Scheme::decaying, Scheme::central_difference, Scheme::midpoint, Scheme::backward_euler}) {
    Scene scene = stiff_joint(scheme, 1e-3, 80);
    scene.joints[0].tensile_strength = 1e5;
    scene.joints[0].cohesion = 1e9;
    Load push;
    push.block = 1;
    push.at = {0.5, 1};
    push.force = history({{0, 0, 0}, {0.2, 2e5, 0}});
    scene.loads = {push};
    const BuiltScene built = build(scene);
    for (int k = 0; k < 80; ++k) {
      ASSERT_TRUE(built.stepper->step());
      ASSERT_LE(std::abs(built.stepper->energy().balance_error()), 1e-6)
          << k << ' ' << static_cast<int>(scheme);
    }
    EXPECT_GT(built.stepper->counts().broken_bonds, 0);
  }
}

/// Held at the limit of friction, which then falls: the slip of the joint takes the work of the friction that
/// is left, T2 (T1 - T2) / k, and not of the springs that relax, (T1 - T2)^2 / 2k.
TEST(JointEnergy, AJointThatWeakensBooksItsSlipAsFriction) {
  for (const BlockModel model : {BlockModel::affine, BlockModel::mesh}) {
    Scene scene = stiff_joint(Scheme::decaying, 0.1, 40);
    scene.analysis.mode = Mode::statics;
    for (BlockDescription& of : scene.blocks) of.model = model;
    scene.supports = {{1, {0, 1, 2, 3}, true, true, history({{0, 0, 0}, {1, 0, -1e-4}, {2, 1e-4, -1e-4}})}};
    StageDescription strong = scene.stage("strong"), weak = scene.stage("weak");
    strong.analysis.steps = weak.analysis.steps = 20;
    weak.joints[0].friction_angle = 15;
    scene.stages = {strong, weak};
    const BuiltScene built = build(scene);
    run(*built.stepper, 20);
    const double before = built.stepper->energy().now.friction_dissipated;
    run(*built.stepper, 20);
    const double strongest = 5e9 * 1e-4, left = 1e6 * std::tan(radians(15)),
                 slipped = (strongest - left) / 5e9;
    EXPECT_NEAR(built.stepper->energy().now.friction_dissipated - before, left * slipped,
                0.02 * left * slipped);
  }
}
