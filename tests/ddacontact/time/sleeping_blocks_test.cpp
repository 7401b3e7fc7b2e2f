// Which blocks take part in a step while others sleep, without a stepper.
#include <ddacontact/time/sleeping_blocks.hpp>
#include <tests/ddacontact/time/trial_of.hpp>

using namespace support;

namespace {

/// Two blocks that have settled on a plate, 3 m apart, the third `height` above the second.
struct Sleepers {
  TrialOf step;
  MotionLimits limits;
  SleepingBlocks sleepers;

  explicit Sleepers(double height)
      : step(scene(height), 40),
        limits(step.blocks, step.analysis),
        sleepers(step.participants, step.contacts, step.properties, limits, step.trial) {}
  static Scene scene(double height) {
    Scene scene = default_mechanics(0.01);
    scene.analysis.skip.sleep = true;
    scene.joints[0].friction_angle = 30;
    scene.blocks = {block(rectangle(-2, -1, 12, 1), true), block(rectangle(0, 0, 1, 1)),
                    block(rectangle(4, 0, 1, 1))};
    if (height > 0) {
      scene.blocks.push_back(block(rectangle(4, 1 + height, 1, 1)));
      scene.blocks[3].velocity = {0, 30};
    }
    return scene;
  }
  /// Steps at rest until some fall asleep; how many it took, 99: none did.
  int steps_to_sleep() {
    for (int k = 1; k < 99; ++k) {
      step.solve();
      if (sleepers.fall_asleep(step.dt())) return k;
    }
    return 99;
  }
};

}  // namespace

TEST(SleepingBlocks, RestAsLongAsIslandsMust) {
  Sleepers two(0);
  EXPECT_EQ(two.steps_to_sleep(), Sleeping::enough);
  EXPECT_TRUE(two.sleepers.is_asleep(1));
  EXPECT_TRUE(two.sleepers.is_asleep(2));
  EXPECT_FALSE(two.sleepers.is_asleep(0)) << "what is held does not sleep";
  EXPECT_EQ(two.sleepers.n_asleep(), 2);
}

TEST(SleepingBlocks, AreLeftOutOfStepsAndComeBack) {
  Sleepers two(0);
  two.steps_to_sleep();
  const std::size_t n_contacts = two.step.contacts.size();
  const Points at = two.step.state.position;
  two.sleepers.regroup();
  EXPECT_EQ(two.sleepers.n_closed(), static_cast<int>(n_contacts));
  EXPECT_EQ(two.sleepers.contacts().size(), n_contacts) << "of the whole";
  {
    const SleepingBlocks::WhileStepping stepping(two.sleepers);
    EXPECT_TRUE(two.step.contacts.empty());
    EXPECT_EQ(two.step.participants.blocks->n_blocks(), static_cast<int>(two.sleepers.in_whole().size()));
    EXPECT_LT(two.step.participants.blocks->n_blocks(), 3);
    EXPECT_EQ(two.step.blocks.n_blocks(), 3) << "the whole is as it was";
  }
  EXPECT_EQ(two.step.participants.blocks, &two.step.blocks);
  EXPECT_EQ(two.step.state.position, at);
  two.sleepers.wake_all();
  EXPECT_EQ(two.sleepers.n_asleep(), 0);
  EXPECT_EQ(two.step.contacts.size(), n_contacts);
  EXPECT_TRUE(two.sleepers.in_whole().empty()) << "the whole takes part";
}

TEST(SleepingBlocks, SleepAgainWhenAWakingIsDiscarded) {
  Sleepers two(0);
  two.steps_to_sleep();
  two.sleepers.regroup();
  two.sleepers.accept();
  const SleepRecord asleep = two.sleepers.record();
  EXPECT_EQ(std::ranges::count(asleep.island, 0), 1) << "the plate";
  two.sleepers.restore({std::vector<int>(3, 0), std::vector<int>(3, 0), {}});
  EXPECT_EQ(two.sleepers.n_asleep(), 0);
  two.sleepers.restore(asleep);
  EXPECT_EQ(two.sleepers.n_asleep(), 2);
  EXPECT_EQ(two.sleepers.record().island, asleep.island);
}

TEST(SleepingBlocks, DoNotSleepWhereItIsOffOrInStaticSteps) {
  Sleepers off(0);
  off.step.analysis.skip.sleep = false;
  EXPECT_EQ(off.steps_to_sleep(), 99);
  Sleepers in_static_steps(0);
  in_static_steps.step.analysis.mode = Mode::statics;
  EXPECT_EQ(in_static_steps.steps_to_sleep(), 99);
}

TEST(SleepingBlocks, WhatFliesStaysAwake) {
  Sleepers with_flight(5);
  with_flight.steps_to_sleep();
  EXPECT_TRUE(with_flight.sleepers.is_asleep(1));
  EXPECT_TRUE(with_flight.sleepers.is_asleep(2));
  EXPECT_FALSE(with_flight.sleepers.is_asleep(3));
  with_flight.sleepers.regroup();
  const SleepingBlocks::WhileStepping stepping(with_flight.sleepers);
  EXPECT_TRUE(std::ranges::count(with_flight.sleepers.in_whole(), 3));
  EXPECT_FALSE(std::ranges::count(with_flight.sleepers.in_whole(), 1)) << "far from what flies";
  EXPECT_EQ(with_flight.sleepers.in_whole(static_cast<int>(with_flight.sleepers.in_whole().size()) - 1), 3);
}
