#include <tests/ddacontact/simple_scenes.hpp>

#include <algorithm>
#include <cmath>

using namespace support;

namespace {

constexpr double cohesion = 20e3, tension = 10e3, depth = 0.05, sinking_time = 0.5;

/// Thirteen bonded bricks on two bases, of which the right one sinks.
Scene sinking_wall(double time_step, double duration) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = static_cast<int>(std::lround(duration / time_step));
  scene.materials = {{"brick", 2500, 1e10, 0.2}};
  scene.joints = {{"mortar", 35, cohesion, tension, std::nullopt}};
  scene.contact.normal_stiffness = 4e11;
  scene.contact.tangential_stiffness = 1.6e11;
  scene.blocks = {block(rectangle(-1, -0.5, 3, 0.5), true), block(rectangle(2, -0.5, 3, 0.5))};
  for (int row = 0; row < 4; ++row)
    for (int k = 0; k < (row % 2 == 0 ? 4 : 3) && scene.blocks.size() < 15; ++k)
      scene.blocks.push_back(block(rectangle(k + row % 2 * 0.5, row * 0.5, 1, 0.5)));
  const TimeFunction sinking{TimeFunction::Kind::history, {0, 0}, {{0, 0, 0}, {sinking_time, 0, -depth}}};
  scene.supports.push_back({1, {0, 1, 2, 3}, true, true, sinking});
  return scene;
}

}  // namespace

TEST(Bonds, NeverBearMoreThanTheirStrengthAndEachBreaksOnce) {
  for (double time_step : {5e-3, 1e-3}) {
    const BuiltScene built = build(sinking_wall(time_step, 0.6));
    Stepper& stepper = *built.stepper;
    const std::vector<Contact> first = stepper.contacts_to_begin_with();
    const auto n_bonds =
        std::count_if(first.begin(), first.end(), [](const Contact& c) { return c.has_bond(); });
    double over = 0;
    for (int step = 0; step < stepper.stages()[0].analysis.steps; ++step) {
      run(stepper, 1);
      for (const ContactRecord& contact : stepper.contacts()) {
        const JointLaw law = stepper.contact_properties().law(contact);
        over = std::max({over, -contact.normal - law.tension,
                         std::abs(contact.shear) - shear_bound(law, contact.normal, true)});
      }
    }
    EXPECT_LE(over, 1e-6 * cohesion);
    EXPECT_GT(stepper.counts().broken_bonds, 10);
    EXPECT_LE(stepper.counts().broken_bonds, n_bonds);
  }
}

/// The base carries the right half of the wall down: the work is its weight's, whatever the steps. Bonds that
/// held beyond their strength until the end of a step let it do work on the wall instead.
TEST(Bonds, ReleaseWhatTheyHeldAndNoMore) {
  for (double time_step : {5e-3, 2e-3, 1e-3}) {
    const BuiltScene built = run(sinking_wall(time_step, 0.6));
    const Energy& energy = built.stepper->energy().now;
    const double weight = 2500 * 9.8 * (1.5 + 4 * 0.5), work = weight * depth;
    EXPECT_NEAR(energy.external, -work, 0.15 * work) << time_step;
    for (double loss : {energy.friction_dissipated, energy.damping_dissipated, energy.numerical_dissipated}) {
      EXPECT_GE(loss, -1e-6 * work);
      EXPECT_LE(loss, 0.1 * work) << time_step;
    }
    EXPECT_LE(energy.pushed_out, 1e-3 * work);
    EXPECT_LE(built.stepper->energy().balance_error(), 1e-10);
  }
}

/// The wall stands on its bonds before the base begins to sink, gently, by as much as breaks some of them: which
/// ones does not depend on the step, as soon as that is shorter than a wave takes through a brick, 0.25 ms.
TEST(Bonds, CracksAreTheSameInAllStepsShorterThanATransit) {
  std::vector<std::vector<std::array<int, 2>>> held;  // blocks that bonds still join, of each bond
  for (const double time_step : {2e-4, 1e-4, 5e-5}) {
    Scene scene = sinking_wall(time_step, 0.45);
    std::vector<Vec3>& history = scene.supports[0].displacement.history;
    history.clear();
    for (int k = 0; k <= 200; ++k) {
      const double s = k / 200.;
      history.push_back({0.2 + 0.4 * s, 0, -0.005 * s * s * s * (10 - 15 * s + 6 * s * s)});
    }
    StageDescription settling = scene.stage("settle");
    settling.analysis.mode = Mode::statics;
    settling.analysis.time_step = 0.01;
    settling.analysis.steps = 20;
    scene.stages = {settling, scene.stage("sink")};
    const BuiltScene built = run(scene);
    std::vector<std::array<int, 2>>& pairs = held.emplace_back();
    for (const ContactRecord& contact : built.stepper->contacts())
      if (contact.history.bonded) pairs.push_back(contact.pair.blocks());
    std::ranges::sort(pairs);
    EXPECT_GT(built.stepper->counts().broken_bonds, 20);
    std::vector<std::array<int, 2>> differ;
    std::ranges::set_symmetric_difference(held.front(), pairs, std::back_inserter(differ));
    EXPECT_LE(differ.size(), 1U) << time_step;
  }
}

/// A block hangs by one of two bonds with its whole weight: with the other gone it falls, in a static step
/// too.
TEST(Bonds, OfAStaticStepBreakOneAfterTheOther) {
  Scene scene = rock_scene(0.02, 3);
  scene.analysis.mode = Mode::statics;
  const double weight = 20e3;  // of a block of 1 x 1 m
  for (const auto& [part, hangs] : {std::pair{1.02, true}, std::pair{0.98, false}}) {
    scene.joints = {{"glue", 30, 1e6, part * weight, std::nullopt}};
    scene.blocks = {block(rectangle(-1, 1, 1.5, 1), true), block(rectangle(0.5, 1, 1.5, 1), true),
                    block(rectangle(0, 0, 1, 1))};
    const BuiltScene built = run(scene);
    EXPECT_EQ(travel(*built.stepper, 2).y() > -1e-3, hangs) << part;
    EXPECT_EQ(built.stepper->counts().broken_bonds == 0, hangs);
  }
}

/// A block of which supports hold the base across the joint, and which a load drives along it: the bond bears
/// the load, though no unknown moves its gap.
TEST(Bonds, BearShearWhereSupportsHoldTheJointShut) {
  for (const Mode mode : {Mode::statics, Mode::dynamic}) {
    Scene scene;
    scene.analysis.mode = mode;
    scene.analysis.time_step = 1e-3;
    scene.analysis.steps = 50;
    scene.materials = {{"rock", 2500, 1e10, 0.2}};
    scene.joints = {{"bond", 30, 1e6, 1e6, std::nullopt}};
    scene.contact.normal_stiffness = scene.contact.tangential_stiffness = 4e11;
    scene.blocks = {block(rectangle(-1, -1, 3, 1), true), block(rectangle(0, 0, 1, 1))};
    scene.supports = {{1, {0, 1}, false, true, {}}};
    Load push;
    push.block = 1;
    push.at = {0.5, 0.5};
    push.force.value = {1e3, 0};
    scene.loads = {push};
    const BuiltScene built = run(scene);
    EXPECT_LE(travel(*built.stepper, 1).norm(), 1e-6);
    double shear = 0;
    for (const ContactRecord& contact : built.stepper->contacts()) shear += contact.shear;
    if (mode == Mode::statics) {
      EXPECT_NEAR(std::abs(shear), 1e3, 1);
    }
  }
}
