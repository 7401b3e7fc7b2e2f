// Joints with a stiffness of their own, residual friction and dilation, against their formulas.
#include <tests/ddacontact/simple_scenes.hpp>

#include <algorithm>

using namespace support;

namespace {

/// Blocks of 2 x 1 m of 40 kN on a fixed one, stiff against their joint.
Scene column(int n_blocks, double normal_stiffness, double shear_stiffness) {
  Scene scene = default_mechanics(rock_scene(0.01, 100), Scheme::midpoint);
  scene.joints[0].friction_angle = 40;
  scene.joints[0].normal_stiffness = normal_stiffness;
  scene.joints[0].shear_stiffness = shear_stiffness;
  scene.blocks = {block(rectangle(-1, -1, 4, 1), true)};
  for (int k = 0; k < n_blocks; ++k) scene.blocks.push_back(block(rectangle(0, k, 2, 1)));
  return scene;
}

double sum_of_shear(const Stepper& stepper) {
  double sum = 0;
  for (const ddacontact::ContactRecord& contact : stepper.contacts()) sum += std::abs(contact.shear);
  return sum;
}

/// A block of 40 kN pushed along its joint by its support, so far a step.
Scene shear_box(bool rigid, double step) {
  Scene scene = column(1, 1e8, 1e8);
  if (rigid) scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = std::nullopt;
  scene.analysis.mode = Mode::statics;
  scene.analysis.time_step = 1;
  scene.analysis.steps = 60;
  scene.supports = {{1, {0, 1, 2, 3}, true, false, {TimeFunction::Kind::rate, {step, 0}, {}}}};
  return scene;
}

}  // namespace

/// The joint closes by more than joints are flush to: a node below the last one of the block, which moves on,
/// has not gone into its side.
TEST(JointSprings, MeshesWhoseNodesMeetSlidePastEachOther) {
  Scene scene = shear_box(false, 1e-5);
  for (BlockDescription& of : scene.blocks) of.model = BlockModel::mesh;
  scene.blocks[1].mesh.cells = 32;
  const BuiltScene built = build(scene);
  run(*built.stepper, 10);
  EXPECT_NEAR(sum_of_shear(*built.stepper), 1e8 * 2 * 1e-4, 1e-3 * 2e4);
  run(*built.stepper, 50);
  EXPECT_NEAR(sum_of_shear(*built.stepper), 40e3 * std::tan(radians(40)), 1e-2 * 40e3);
}

TEST(JointSprings, OfAColumnCloseByTheWeightAboveOverTheirStiffness) {
  for (const Scheme scheme : {Scheme::midpoint, Scheme::decaying, Scheme::backward_euler}) {
    Scene scene = column(4, 1e7, 1e6);
    scene.analysis.mode = Mode::statics;
    scene.analysis.scheme = scheme;
    scene.analysis.time_step = 1;
    scene.analysis.steps = 30;
    scene.materials[0].young = 1e9;
    const BuiltScene built = run(scene);
    ASSERT_EQ(built.stepper->contacts().size(), 8u);
    ASSERT_EQ(built.notes.size(), 1u);
    EXPECT_NE(built.notes[0].find("resists three times as much"), std::string::npos);
    for (const ddacontact::ContactRecord& contact : built.stepper->contacts()) {
      const double above = 40e3 * (5 - std::max(contact.pair.vertex_block, contact.pair.edge_block)),
                   closure = above / (1e7 * 2);
      EXPECT_NEAR(contact.end_gap, -closure, 1e-8 * closure);
    }
  }
}

/// Each gap between nodes of either side belongs to the two at its ends, however near they are and wherever
/// the blocks have slid.
TEST(JointSprings, BetweenMeshesHaveTheLengthOfTheJoint) {
  for (const double offset : {0.0, 1e-7, 1e-4, 5e-3, 0.03, 0.125}) {
    Scene scene = column(1, 1e9, 1e9);
    scene.joints[0].friction_angle = 5;
    scene.materials[0].young = 5e10;
    scene.analysis.scheme = Scheme::decaying;
    scene.analysis.steps = 60;
    scene.blocks[1] = block(rectangle(offset, 0, 2, 1));
    scene.blocks[1].velocity = {0.5, 0};
    for (ddacontact::BlockDescription& of : scene.blocks) {
      of.model = BlockModel::mesh;
      of.mesh.cell_size = 0.25;
    }
    scene.blocks[0].fixed = false;
    scene.supports = {{0, {0, 1}, true, true, {}}};
    BuiltScene built = build(scene);
    Stepper& stepper = *built.stepper;
    int n_entering = 0;
    for (int step = 0; step < 60; ++step) {
      ASSERT_TRUE(stepper.step());
      double length = 0;
      for (const ddacontact::ContactRecord& contact : stepper.contacts())
        if (contact.closed()) length += contact.history.length;
      // Where a node comes in at an end within the step both its joint and the corner beside it have theirs.
      n_entering += length > 2 + 1e-4;
      ASSERT_GT(length, 2 - 1e-4) << "offset " << offset << ", step " << step;
      ASSERT_LT(length, 2.13) << "offset " << offset << ", step " << step;
    }
    EXPECT_LE(n_entering, 1);
    EXPECT_GT(travel(stepper, 1).x(), 0.1);
    // Shear stress is not handed on where a contact takes over a part of the length.
    EXPECT_LT(std::abs(stepper.energy().balance_error()), 1e-4);
  }
}

/// From one floor onto the next: the corner that the block comes to has a part of the length from then on,
/// and of the weight.
/// Where both faces have vertices at the same places, which strains move apart by a little, each place bears
/// once.
TEST(JointSprings, BetweenTwoMeshesBearOnceAPlace) {
  for (const double cell_size : {0.5, 0.25})
    for (const double young : {1e9, 1e11}) {
      Scene scene = column(3, 1e8, 5e7);
      scene.materials[0].young = young;
      for (BlockDescription& b : scene.blocks) {
        b.model = BlockModel::mesh;
        b.mesh.cell_size = cell_size;
      }
      scene.analysis.mode = Mode::statics;
      scene.analysis.time_step = 0.05;
      scene.analysis.steps = 60;
      const BuiltScene built = run(scene);
      for (int below = 0; below < 3; ++below) {
        double length = 0, force = 0;
        for (const ddacontact::ContactRecord& contact : built.stepper->contacts()) {
          if (std::min(contact.pair.vertex_block, contact.pair.edge_block) != below) continue;
          length += contact.history.length;
          force += contact.normal;
        }
        EXPECT_NEAR(length, 2, 0.01) << cell_size << " m, " << young << " Pa, above block " << below;
        EXPECT_NEAR(force, 40e3 * (3 - below), 1);
      }
    }
}

/// However far the joint closes, under a load in its core: N / (k b) and 12 N e / (k b^3) at its middle.
TEST(JointSprings, BetweenTwoMeshesFollowALoadOffCentre) {
  for (const double rounding : {0., 0.003}) {
    Scene scene = column(1, 1e8, 1e8);
    scene.contact.corner_rounding = rounding;
    scene.materials[0].young = 1e12;
    scene.analysis.gravity.setZero();
    scene.analysis.mode = Mode::statics;
    scene.analysis.time_step = 0.02;
    scene.analysis.steps = 60;
    for (BlockDescription& b : scene.blocks) {
      b.model = BlockModel::mesh;
      b.mesh.cell_size = 0.25;
    }
    scene.loads = {point_load(1, Vec2(1.1, 0.999), constant({0, -6e5}))};
    const BuiltScene built = run(scene);
    const Stepper& stepper = *built.stepper;
    EXPECT_NEAR(travel(stepper, 1).y(), -3e-3, 2e-5) << "rounding " << rounding;
    EXPECT_NEAR(-stepper.state().rotation[1], 12 * 6e5 * 0.1 / (1e8 * 8), 3e-5) << "rounding " << rounding;
  }
}

TEST(JointSprings, BearABlockThatSlidesOntoAnotherFloor) {
  Scene scene = column(1, 1e9, 1e9);
  scene.joints[0].friction_angle = 5;
  scene.materials[0].young = 5e10;
  scene.analysis.scheme = Scheme::decaying;
  scene.analysis.time_step = 0.005;
  scene.blocks = {block(rectangle(-6, -1, 6, 1), true), block(rectangle(0, -1, 6, 1), true),
                  block(rectangle(-2.3, 0, 2, 1))};
  scene.blocks[2].velocity = {1.5, 0};
  BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  for (int step = 0; step < 200; ++step) {
    ASSERT_TRUE(stepper.step());
    if (travel(stepper, 2).x() < 0.35) continue;  // it is yet to come over the corner
    for (const ddacontact::ContactRecord& contact : stepper.contacts())
      if (contact.closed() && contact.normal > 0) {
        ASSERT_NEAR(contact.normal, -1e9 * contact.history.length * contact.end_gap, 1e-6 * 40e3) << step;
      }
    ASSERT_LT(std::abs(stepper.state().rotation[2]), 1e-5) << step;
  }
  EXPECT_GT(travel(stepper, 2).x(), 1);
}

/// The same where the joint has closed by .5 mm, more than the lip: v^2 / (2 g tan(phi)).
TEST(JointSprings, LetABlockPassTheSeamOfLevelFloorsHoweverFarTheyHaveClosed) {
  Scene scene = column(1, 4e7, 4e7);
  scene.joints[0].friction_angle = 5;
  scene.materials[0].young = 5e10;
  scene.analysis.scheme = Scheme::decaying;
  scene.blocks = {block(rectangle(-6, -1, 6, 1), true), block(rectangle(0, -1, 6, 1), true),
                  block(rectangle(-2.3, 0, 2, 1))};
  scene.blocks[2].velocity = {1.5, 0};
  const BuiltScene built = build(scene);
  run(*built.stepper, 250);
  const double way = 1.5 * 1.5 / (2 * 10 * std::tan(radians(5)));
  EXPECT_NEAR(travel(*built.stepper, 2).x(), way, 0.02 * way);
  EXPECT_NEAR(travel(*built.stepper, 2).y(), -40e3 / (4e7 * 2), 1e-5);
  EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-9) << "contacts are taken over";
}

TEST(JointSprings, KeepTheLedgerClosedWhereContactsOpenAndCloseAgain) {
  for (const Scheme scheme : {Scheme::midpoint, Scheme::newmark, Scheme::decaying}) {
    Scene scene = column(1, 1e9, 4e8);
    scene.joints[0].friction_angle = 20;
    scene.materials[0].young = 5e9;
    scene.analysis.scheme = scheme;
    scene.analysis.time_step = 0.0005;
    scene.blocks[1].velocity = {0.5, -1};
    const BuiltScene built = build(scene);
    long n_open = 0;
    for (int k = 0; k < 240; ++k) {
      run(*built.stepper, 1);
      n_open += std::ranges::none_of(built.stepper->contacts(), &ContactRecord::closed);
      EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-9) << static_cast<int>(scheme);
    }
    EXPECT_GT(n_open, 0);
  }
}

/// The midpoint rule keeps the energy of a linear spring and turns its phase by 2 atan(w dt / 2) a step.
TEST(JointSprings, CarryABlockAsAnOscillatorOfTheSchemesPeriod) {
  Scene scene = column(1, 1e6, 1e6);
  scene.materials[0].young = 1e14;
  scene.joints[0].cohesion = scene.joints[0].tensile_strength = 1e9;
  scene.analysis.gravity = Vec2::Zero();
  scene.blocks[1].velocity = {0, -0.1};
  const double w = std::sqrt(1e6 * 2 / 4000), phase = 2 * std::atan(w * 0.01 / 2), amplitude = 0.1 / w;
  const BuiltScene built = build(scene);
  for (int k = 1; k <= 1000; ++k) {
    run(*built.stepper, 1);
    const double y = travel(*built.stepper, 1).y();
    ASSERT_NEAR(y, -amplitude * std::sin(k * phase), 1e-5 * amplitude) << k;
    const double v = momentum(*built.stepper, 1).y() / 4000;
    ASSERT_NEAR(std::hypot(y, v / w), amplitude, 1e-8 * amplitude) << k;
  }
  const Energy& now = built.stepper->energy().now;
  EXPECT_NEAR(now.kinetic + now.elastic, 20, 1e-6);
}

TEST(JointSprings, TakeShearUpToFrictionAndThenItsResidual) {
  for (const bool rigid : {false, true}) {
    Scene scene = shear_box(rigid, 1e-5);
    scene.joints[0].residual_friction_angle = 25;
    const BuiltScene built = build(scene);
    double peak = 0;
    for (int k = 1; k <= 60; ++k) {
      run(*built.stepper, 1);
      const double shear = sum_of_shear(*built.stepper);
      peak = std::max(peak, shear);
      if (!rigid && k == 10) {
        EXPECT_NEAR(shear, 1e8 * 2 * k * 1e-5, 1e-3 * shear);
      }
    }
    EXPECT_NEAR(sum_of_shear(*built.stepper), 40e3 * std::tan(radians(25)), 1e-6 * 40e3);
    EXPECT_NEAR(peak, 40e3 * std::tan(radians(40)), 1e-3 * 40e3);
    EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-6);
  }
}

/// Friction lifts a block that slides by tan(i) of its slip, and no further when it has slid so far.
TEST(JointSprings, LiftABlockThatSlidesByTheDilationAngle) {
  for (const bool rigid : {false, true}) {
    Scene scene = shear_box(rigid, 1e-3);
    scene.joints[0].dilation_angle = 8;
    scene.joints[0].dilation_slip = 0.04;
    const BuiltScene built = build(scene);
    run(*built.stepper, 20);
    const Vec2 before = travel(*built.stepper, 1);
    run(*built.stepper, 15);
    const Vec2 way = travel(*built.stepper, 1) - before;
    EXPECT_NEAR(way.y() / way.x(), std::tan(radians(8)), 1e-3 * std::tan(radians(8)));
    run(*built.stepper, 25);
    double gap = 0;
    for (const ddacontact::ContactRecord& contact : built.stepper->contacts())
      gap += (contact.end_gap + contact.history.gap_offset) / 2;
    EXPECT_NEAR(gap, 0.04 * std::tan(radians(8)) - (rigid ? 0 : 40e3 / (1e8 * 2)), 2e-6);
    EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-6);
    EXPECT_GT(built.stepper->energy().now.friction_dissipated, 0);
  }
}

/// On a block that is lifted the normal force is N = W / (1 + tan(phi) tan(i)). Thrown along its joint it is
/// first slowed by the impulse that lifts it, by 1 + tan(phi) tan(i) as well.
TEST(JointSprings, LiftABlockThatIsThrown) {
  const double rise = std::tan(radians(8)), friction = std::tan(radians(30)), less = 1 + friction * rise,
               way = 1 / (less * less) / (2 * 10 * friction / less);
  for (const bool rigid : {false, true}) {
    Scene scene = column(1, 1e9, 1e9);
    if (rigid) scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = std::nullopt;
    scene.analysis.scheme = Scheme::decaying;
    scene.analysis.max_displacement_ratio = 1;
    scene.materials[0].young = 1e9;
    scene.joints[0].friction_angle = 30;
    scene.joints[0].dilation_angle = 8;
    scene.joints[0].dilation_slip = 1;
    scene.blocks[1].velocity = {1, 0};
    const BuiltScene built = build(scene);
    run(*built.stepper, 8);
    double normal = 0;
    for (const ddacontact::ContactRecord& contact : built.stepper->contacts()) normal += contact.normal;
    EXPECT_NEAR(normal, 40e3 / less, 2e-3 * 40e3) << rigid;
    run(*built.stepper, 30);
    EXPECT_NEAR(travel(*built.stepper, 1).x(), way, 2e-3 * way) << rigid;
    EXPECT_NEAR(travel(*built.stepper, 1).y(), rise * way, 5e-3 * rise * way) << rigid;
    EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-9);
  }
}

/// Rounded corners that sink by less than their radius and by more: as the joint's stiffness says.
TEST(JointSprings, MayCloseByMoreThanTheRadiusOfCorners) {
  for (const double stiffness : {1e7, 4e6, 2e6, 1e6}) {
    Scene scene = column(1, stiffness, stiffness);
    scene.analysis.mode = Mode::statics;
    scene.analysis.time_step = 0.1;
    scene.materials[0].young = 5e9;
    scene.contact.corner_rounding = 0.005;
    const BuiltScene built = run(scene);
    EXPECT_NEAR(travel(*built.stepper, 1).y(), -20e3 / stiffness, 1e-2 * 20e3 / stiffness);
    EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-6);
  }
}

/// A footing whose middle third is stiffer, with vertices of both faces where the joint changes: it sinks
/// level, by its weight over the sum of all stiffness.
TEST(JointSprings, WhereTwoJointsMeetEachBearsOverItsLength) {
  for (const double ratio : {50., 0.1}) {
    Scene scene = column(0, 1e7, 1e6);
    scene.analysis.mode = Mode::statics;
    scene.analysis.scheme = Scheme::decaying;
    scene.analysis.time_step = 1;
    scene.analysis.steps = 60;
    scene.analysis.block_model = BlockModel::affine;
    scene.materials[0].young = 1e13;
    scene.joints.push_back(scene.joints[0]);
    scene.joints[1].name = "middle";
    scene.joints[1].normal_stiffness = 1e7 * ratio;
    scene.joints[1].shear_stiffness = 1e6 * ratio;
    Points upper(2, 6), lower(2, 8);
    upper << 0, 1, 2, 3, 3, 0,  //
        0, 0, 0, 0, 1, 1;
    lower << -1, 4, 4, 3, 2, 1, 0, -1,  //
        -1, -1, 0, 0, 0, 0, 0, 0;
    scene.blocks = {block(lower, true), block(upper)};
    scene.blocks[0].edge_joints = {0, 0, 0, 0, 1, 0, 0, 0};
    scene.blocks[1].edge_joints = {0, 1, 0, 0, 0, 0};
    for (BlockDescription& of : scene.blocks) of.model = BlockModel::affine;
    const BuiltScene built = run(scene);
    const double closure = 60e3 / (2e7 + 1e7 * ratio);
    for (const ContactRecord& contact : built.stepper->contacts())
      EXPECT_NEAR(contact.end_gap, -closure, 1e-4 * closure);
    EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-10);
  }
}

/// A dashpot between two blocks that supports lead has no mass to be measured by.
TEST(JointSprings, BetweenBlocksThatSupportsLeadHaveNoDashpot) {
  Scene scene = column(1, 1e7, 1e6);
  scene.joints[0].dashpot = 0.3;
  const TimeFunction lead = history_function(TimeFunction::Kind::history, {{0, 0, 0}, {0.5, 1e-4, -1e-4}});
  scene.supports = {{1, {0, 1, 2, 3}, true, true, lead}};
  const BuiltScene built = run(scene);
  EXPECT_TRUE(std::isfinite(built.stepper->energy().now.total()));
  double normal = 0;
  for (const ContactRecord& contact : built.stepper->contacts()) normal += contact.normal;
  EXPECT_NEAR(normal, 1e7 * 2 * 1e-4, 1e-3 * normal);
}

/// However short the step: neither balance nor a correction asks for these forces.
TEST(JointSprings, BetweenBlocksThatSupportsLeadFollowTheirLaw) {
  for (const double step : {0.05, 0.01, 1e-3, 1e-4})
    for (const double apart : {-1e-4, 1e-4}) {
      SCOPED_TRACE(testing::Message() << step << " s, " << apart << " m apart");
      Scene scene = column(1, 1e7, 4e6);
      scene.analysis.time_step = step;
      scene.analysis.steps = 6;
      scene.joints[0].cohesion = 20;
      scene.joints[0].tensile_strength = 400;
      scene.supports = {
          {1,
           {0, 1, 2, 3},
           true,
           true,
           history_function(TimeFunction::Kind::history, {{0, 0, 0}, {4 * step, 2e-4, apart}})}};
      const BuiltScene built = run(scene);
      double normal = 0;
      for (const ContactRecord& contact : built.stepper->contacts()) normal += contact.normal;
      EXPECT_NEAR(normal, apart < 0 ? 1e7 * 2 * 1e-4 : 0, 1e-2);
      EXPECT_NEAR(sum_of_shear(*built.stepper), apart < 0 ? 4e6 * 2 * 2e-4 : 0, 1e-2);
    }
}

/// A block of 40 kN on a roof whose bond bears less: its springs store what their force has strained, not
/// what the block has fallen.
TEST(JointSprings, OfABondThatYieldsStoreNoMoreThanItsStrength) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::backward_euler}) {
    Scene scene = column(1, 1e10, 1e10);
    scene.analysis.scheme = scheme;
    scene.analysis.time_step = 0.02;
    scene.analysis.steps = 1;
    scene.joints[0].cohesion = scene.joints[0].tensile_strength = 10e3;
    scene.blocks = {block(rectangle(-1, 1, 4, 1), true), block(rectangle(0, 0, 2, 1))};
    scene.materials[0].young = 1e10;
    const BuiltScene built = run(scene);
    EXPECT_LE(built.stepper->energy().now.elastic, 0.05);
    EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-6);
  }
}
