#include <ddacontact/solver/swept_step.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// Two blocks of 40 kN beside each other on a plate, in a short step by the default mechanics.
struct SweptBlocks {
  BuiltScene built;
  std::vector<Contact> list;
  StepSystem system;
  ContactSolverOptions options{std::nullopt, 1e-6};
  VectorXd d;
  ContactSolverReport report;

  explicit SweptBlocks(double speed)
      : built(build(scene(speed))), list(built.stepper->contacts_to_begin_with()), system(blocks_of(built)) {
    const BlockState& state = built.stepper->state();
    StepRule rule;
    rule.scheme = Scheme::decaying;
    system.problem().contacts_changed();
    system.set_step(state, {rule, 1e-4, state.velocity, VectorXd::Zero(state.velocity.size())}, 1e9);
    d = system.free_path();
    options.directions = rule.directions();
    options.local = true;
  }
  static Scene scene(double speed) {
    Scene scene = default_mechanics(rock_scene(1e-4, 1));
    scene.materials[0].young = 1e14;
    scene.joints[0].friction_angle = 30;
    scene.blocks = {block(rectangle(-2, -1, 12, 1), true), block(rectangle(0, 0, 2, 1)),
                    block(rectangle(4, 0, 2, 1))};
    for (int b : {1, 2}) scene.blocks[static_cast<std::size_t>(b)].velocity = {speed, 0};
    return scene;
  }
  bool solve() {
    system.linearize(d);
    AugmentedContacts contacts(system, options, list);
    contacts.begin();
    contacts.evaluate(d);
    const bool solved = solve_by_sweeps(system, options, contacts, d, report);
    if (solved) contacts.settle(1);
    return solved;
  }
};

}  // namespace

TEST(SweptStep, FindsTheForcesThatBearAndSlowTheBlocks) {
  for (const double speed : {0., 1., -1.}) {
    SweptBlocks blocks(speed);
    ASSERT_TRUE(blocks.solve());
    EXPECT_GT(blocks.report.sweeps, 0);
    EXPECT_EQ(blocks.report.tolerance, blocks.options.sweep_tolerance);
    EXPECT_LE(blocks.report.residual.block_relative, blocks.options.sweep_tolerance);
    double normal = 0, shear = 0;
    for (const Contact& contact : blocks.list) {
      normal += contact.normal;
      shear += contact.shear;
      EXPECT_EQ(is_slipping(contact.history.state), speed != 0);
    }
    EXPECT_NEAR(normal, 80e3, 80) << "less what the blocks give way by";
    // On the vertices, positive to the left, where the upper side of the plate runs.
    const double sense = (speed > 0) - (speed < 0);
    EXPECT_NEAR(shear, sense * std::tan(radians(30)) * normal, 1e-2);
  }
}

/// In other steps the active-set iteration decides: from where it would have begun.
TEST(SweptStep, LeavesStepsThatAreNotLocalUnlessManyContactsChange) {
  SweptBlocks blocks(0);
  blocks.options.local = false;
  blocks.options.coarse = true;
  const VectorXd before = blocks.d;
  EXPECT_FALSE(blocks.solve());
  EXPECT_EQ(blocks.d, before);
  EXPECT_EQ(blocks.report.sweep_fallbacks, 0);
}
