/// \file What the look at an accepted step counts. How it is worded, and in which runs, tests/equilibrium
/// has.
#include <ddacontact/time/run_warnings.hpp>
#include <ddacontact/time/waves.hpp>
#include <tests/ddacontact/time/trial_of.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// Five blocks of 1 m x 1 m on a held one, number 5, and a step that they have made.
struct AStep {
  BuiltScene built = build(scene());
  const BlockSystem& blocks = built.stepper->blocks();
  BlockState state = blocks.initial_state();
  VectorXd d = VectorXd::Zero(blocks.n_unknowns());
  std::vector<Contact> contacts;
  double dt = transit_time(blocks.block(0)) / 2, time = 1;
  bool has_velocities = true, is_first = false;
  std::vector<int> in_whole;
  RunWarnings warnings = RunWarnings(6);

  static Scene scene() {
    Scene scene = default_mechanics(0.01);
    for (int k = 0; k < 5; ++k) scene.blocks.push_back(block(rectangle(3 * k, 0, 1, 1)));
    scene.blocks.push_back(block(rectangle(-5, -1, 30, 1), true));
    return scene;
  }
  /// Between a block and the held one.
  Contact& add_contact(int b, ContactState before = ContactState::stick,
                       ContactState after = ContactState::stick) {
    Contact& contact = contacts.emplace_back();
    contact.pair = {b, 0, 5, 2};
    contact.start_state = before;
    contact.history.state = after;
    contact.size = 1;
    return contact;
  }
  void shift(int b, double by) {
    const Block& of = blocks.block(b);
    of.unknowns().of(d) = of.translations().col(0) * by;
  }
  /// Makes it longer by this part.
  void stretch(int b, double strain) {
    blocks.block(b).points().columns_of(state.position).row(0) *= 1 + strain;
  }
  RunWarnings& look() {
    warnings.note({blocks, state, d, contacts, dt, time, has_velocities, is_first, in_whole});
    return warnings;
  }
};

}  // namespace

TEST(RunWarnings, SightingsCountAndKeepTheFirstTimeAndTheWorst) {
  RunWarnings::Sighting sighting;
  sighting.add(0.2, 3, 1.5);
  sighting.add(0.4, 7, 2);
  sighting.add(0.3, 8, 2.5);
  EXPECT_EQ(sighting.substeps, 3);
  EXPECT_EQ(sighting.first_time, 1.5);
  EXPECT_EQ(sighting.largest, 0.4);
  EXPECT_EQ(sighting.block, 7);
}

/// More than a tenth of a block's size; flight is exact whatever the step.
TEST(RunWarnings, LongWaysOfBlocksInContactAreCounted) {
  AStep step;
  step.add_contact(1);
  step.add_contact(2);
  step.shift(0, 5);
  step.shift(1, 0.11);
  step.shift(2, 0.12);
  step.shift(3, 5);
  EXPECT_EQ(step.look().far.substeps, 1);
  EXPECT_NEAR(step.warnings.far.largest, 0.12, 1e-12);
  EXPECT_EQ(step.warnings.far.block, 2);
  EXPECT_EQ(step.warnings.far.first_time, 1);
  step.shift(1, 0.09);
  step.shift(2, -0.09);
  EXPECT_EQ(step.look().far.substeps, 1) << "by less than a tenth";
}

/// More than a twentieth, of one that is longer or shorter.
TEST(RunWarnings, LargeStrainsOfBlocksInContactAreCounted) {
  for (const double strain : {0.06, -0.06, 0.04, -0.04}) {
    AStep step;
    step.stretch(1, strain);
    step.add_contact(0);
    EXPECT_EQ(step.look().strained.substeps, 0) << "it is another one";
    step.add_contact(1);
    const bool counts = std::abs(strain) > large_strain;
    EXPECT_EQ(step.look().strained.substeps, counts);
    if (counts) {
      EXPECT_NEAR(step.warnings.strained.largest, 0.06, 1e-12);
      EXPECT_EQ(step.warnings.strained.block, 1);
    }
  }
}

/// Three of four; none of fewer blocks, none in the first step, which has no state before it.
TEST(RunWarnings, StatesThatChangeOnMostBlocksAreCounted) {
  AStep step;
  for (int b = 0; b < 3; ++b) step.add_contact(b, ContactState::stick, ContactState::slip_forward);
  EXPECT_EQ(step.look().changed.substeps, 0) << "three blocks are too few";
  step.add_contact(3);
  step.is_first = true;
  EXPECT_EQ(step.look().changed.substeps, 0);
  step.is_first = false;
  EXPECT_EQ(step.look().changed.substeps, 1);
  EXPECT_EQ(step.warnings.changed.largest, 0.75);
  step.contacts[0].history.state = ContactState::stick;
  EXPECT_EQ(step.look().changed.substeps, 1) << "half of them are not most";
  step.add_contact(4, ContactState::stick, ContactState::open);
  EXPECT_EQ(step.look().changed.substeps, 2);
  EXPECT_EQ(step.warnings.changed.largest, 0.75) << "three of five are less";
}

/// Dynamic steps shorter than a wave takes through the block.
TEST(RunWarnings, SlidingBlocksAreCountedAndThoseWhoseContactsChange) {
  AStep step;
  step.add_contact(0).slip_change = 1e-3;
  step.add_contact(1, ContactState::stick, ContactState::slip_forward).slip_change = -1e-3;
  step.add_contact(2, ContactState::stick, ContactState::slip_forward);
  step.add_contact(3, ContactState::stick, ContactState::open).slip_change = 1e-3;
  step.look();
  EXPECT_EQ(step.warnings.slid, (std::vector<long>{1, 1, 0, 0, 0, 0}));
  EXPECT_EQ(step.warnings.unsteady, (std::vector<long>{0, 1, 0, 0, 0, 0}));
  step.has_velocities = false;
  step.look();
  step.has_velocities = true;
  step.dt *= 4;
  step.look();
  EXPECT_EQ(step.warnings.slid, (std::vector<long>{1, 1, 0, 0, 0, 0}));
}

TEST(RunWarnings, BlocksOfAPartAreNamedByTheirNumbersInTheWhole) {
  AStep step;
  step.in_whole = {4, 3, 2, 1, 0, 5};
  step.shift(1, 0.2);
  step.stretch(0, 0.1);
  step.add_contact(0);
  step.add_contact(1).slip_change = 1e-3;
  step.look();
  EXPECT_EQ(step.warnings.far.block, 3);
  EXPECT_EQ(step.warnings.strained.block, 4);
  EXPECT_EQ(step.warnings.slid, (std::vector<long>{0, 0, 0, 1, 0, 0}));
}

/// What held a corner before a static step has no effect on it; held blocks and open contacts say nothing.
TEST(RunWarnings, StaticStepsForgetCaughtCornersAndOpenContactsCountNothing) {
  AStep step;
  step.warnings.caught.add(1, 2, 0.5);
  step.shift(0, 0.5);
  step.add_contact(0, ContactState::open, ContactState::open);
  EXPECT_EQ(step.look().caught.substeps, 1);
  step.has_velocities = false;
  EXPECT_EQ(step.look().caught.substeps, 0);
  EXPECT_EQ(step.warnings.far.substeps, 0);
}
