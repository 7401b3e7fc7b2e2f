#include <tests/support/hard_steps.hpp>
#include <tests/support/random_scenes.hpp>
#include <tests/support/step_record_text.hpp>

#include <gtest/gtest.h>

#include <sstream>

using namespace ddacontact;
using namespace support;

TEST(StepRecord, ReadsBackAndTheRunGoesOnAsItWould) {
  const Scene scene = random_drop(5);
  const BuiltScene first = build(scene), second = build(scene);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(first.stepper->step());
  std::stringstream text;
  write_record(text, first.stepper->record());
  second.stepper->restore(read_record(text));
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(first.stepper->step() && second.stepper->step());
  const BlockState &a = first.stepper->state(), &b = second.stepper->state();
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
}

TEST(StepRecord, RefusesWhatIsNone) {
  for (const char* record : {"0x1p+0 nonsense", "0x1p+0 nan", "0x1p+0 -0x1p+900"}) {
    std::istringstream text(record);
    EXPECT_THROW((void)read_record(text), Error) << record;
  }
}

/// A step that does not balance is cut: never accepted as it is. Most balance at the length they were
/// recorded with.
TEST(HardSteps, StagedMethodMakesEachAndMostWithoutCutting) {
  const std::vector<HardStep> steps = hard_steps();
  ASSERT_GE(steps.size(), 50u);
  std::size_t uncut = 0;
  for (const HardStep& step : steps) {
    SCOPED_TRACE(step.name);
    const BuiltScene built = build_at(step);
    EXPECT_TRUE(built.stepper->step()) << built.stepper->stop_reason();
    EXPECT_LE(built.stepper->counts().max_residual, 1e-8);
    EXPECT_LE(largest_overlap(*built.stepper), 1e-4);
    EXPECT_TRUE(built.stepper->state().position.allFinite());
    uncut += built.stepper->counts().rejected == 0;
  }
  EXPECT_GE(uncut, 50u);
}

/// Steps that the active-set iteration alone does not solve are solved by the interior-point method, in some
/// thirty solutions and those that end it.
TEST(HardSteps, TheInteriorPointMethodSolvesStepsThatTheActiveSetAloneDoesNot) {
  int solved = 0, gained = 0, lost = 0;
  for (const HardStep& step : hard_steps()) {
    SCOPED_TRACE(step.name);
    const auto makes = [&](bool inside) {
      HardStep once = step;
      once.scene.contact.method = ContactMethod::staged;
      once.scene.analysis.cutting_factor = 1e-4;  // the first rejected try is the last
      const BuiltScene built = build_at(once);
      Stepper& stepper = *built.stepper;
      stepper.contact_solver_options().interior_point = inside;
      const bool made = stepper.step();
      EXPECT_TRUE(inside || stepper.counts().interior_point_solves == 0);
      if (made && inside && stepper.counts().substeps == 1) {
        EXPECT_LE(stepper.counts().contact_iterations, 300 * (1 + stepper.counts().corner_solutions));
      }
      return made;
    };
    const bool alone = makes(false), with = makes(true);
    solved += with;
    gained += with && !alone;
    lost += alone && !with;
  }
  EXPECT_GE(solved, 52);
  EXPECT_GE(gained, 9);  // the active set alone makes 43
  EXPECT_EQ(lost, 0);
}

TEST(RandomDrops, BalanceInNearlyEveryTryAndBlocksStayApart) {
  long steps = 0, rejected = 0;
  for (std::uint64_t seed = 1000; seed < 1090; ++seed) {
    const Scene scene = random_drop(seed);
    if (drop_kind(seed) == DropKind::pile && seed > 1020) continue;
    SCOPED_TRACE(name_of(drop_kind(seed)) + ' ' + std::to_string(seed));
    const BuiltScene built = build(scene);
    Stepper& stepper = *built.stepper;
    for (int k = 0; k < scene.analysis.steps; ++k) {
      ASSERT_TRUE(stepper.step()) << stepper.stop_reason();
      if (k % 10 == 0) {
        EXPECT_LE(largest_overlap(stepper), 1e-4) << "step " << k;
      }
    }
    EXPECT_TRUE(stepper.state().position.allFinite());
    EXPECT_LE(stepper.counts().max_residual, 1e-8);
    steps += stepper.counts().steps;
    rejected += stepper.counts().rejected;
  }
  EXPECT_LE(rejected, steps / 100) << rejected << " of " << steps;
}
