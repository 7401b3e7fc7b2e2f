// Polygons of any shape that fall, collide, slide and come to rest: nothing passes through anything.
#include <tests/support/any_drops.hpp>
#include <tests/support/hard_steps.hpp>
#include <tests/support/random_scenes.hpp>

#include <ddacontact/time/run_record.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using namespace support;

TEST(AnyDrops, StayApartAndRunToTheirEnd) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const AnyDrop drop = run_any_drop(seed);
    SCOPED_TRACE(name_of(ground_of(seed)) + ' ' + std::to_string(seed) + ": " + drop.failure);
    EXPECT_EQ(drop.stopped_by, "");
    EXPECT_LE(drop.overlap, overlap_limit);
    EXPECT_FALSE(drop.passed);
    EXPECT_GE(drop.blocks, 1);
    EXPECT_LE(drop.rise, 1e-4);
  }
}

/// Corners that pass corners: these overlapped when the line that a corner meets was chosen before its motion
/// was known.
TEST(AnyDrops, CornersThatPassCornersDoNotGoIn) {
  const AnyDrop vessel = run_any_drop(287);
  EXPECT_LE(vessel.overlap, overlap_limit);

  const Scene pile = random_drop(591);
  const BuiltScene built = build(pile);
  Stepper& stepper = *built.stepper;
  for (int k = 0; k < pile.analysis.steps; ++k) {
    ASSERT_TRUE(stepper.step()) << stepper.stop_reason();
    EXPECT_LE(largest_overlap(stepper), overlap_limit) << "step " << k;
  }

  const AnyDrop missed = run_any_drop(182);  // a corner goes in where nothing led it to before the step
  EXPECT_LE(missed.overlap, overlap_limit);
  EXPECT_GE(missed.overlap_rejections, 1);
}

/// A drop whose U has a straight vertex at the middle of a side of an ear.
TEST(AnyDrops, AnUWithStraightCornersMoves) {
  const AnyDrop drop = run_any_drop(47);
  EXPECT_EQ(drop.stopped_by, "");
}

/// Each of these has a step at whose end an impact of a block that touches another is yet to come. Its
/// velocity was that of the middle of the step then, and its energy fell and came back by up to 2e-3.
TEST(AnyDrops, ImpactsToComeLeaveTheVelocityAsItIs) {
  for (const std::uint64_t seed : {59, 73, 237, 268, 304}) EXPECT_EQ(run_any_drop(seed).rises, 0) << seed;
}

/// Each has a step that is solvable only when it is cut: the velocity at its start comes from the first part.
TEST(AnyDrops, StepsToBeCutLeaveTheVelocityAsItIs) {
  for (const std::uint64_t seed : {3635, 4182, 6851, 8613}) EXPECT_EQ(run_any_drop(seed).rises, 0) << seed;
}

/// Before and after the step that is cut (60) a record goes on as the run does.
TEST(AnyDrops, ARecordBeforeAStepToBeCutGoesOnAsTheRunDoes) {
  const Scene scene = any_drop(6851);
  const BuiltScene whole = build(scene);
  for (int k = 0; k < 63; ++k) {
    const RunRecord record = whole.stepper->run_record();
    ASSERT_TRUE(whole.stepper->step());
    if (k < 58) continue;
    const BuiltScene resumed = build(scene);
    resumed.stepper->restore(record);
    ASSERT_TRUE(resumed.stepper->step());
    EXPECT_TRUE(to_bytes(resumed.stepper->run_record()) == to_bytes(whole.stepper->run_record())) << k;
  }
  EXPECT_EQ(whole.stepper->counts().rejected, 1);
  EXPECT_EQ(whole.stepper->counts().unknown_velocities, 0);
}

/// An interior-point iteration that starts where no contact acts.
TEST(AnyDrops, ContactsMayBeginToActOnTheWayToASolution) {
  EXPECT_EQ(run_any_drop(1846).stopped_by, "");
}
