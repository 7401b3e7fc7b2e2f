// Which lines corners meet.
#include <tests/ddacontact/time/trial_of.hpp>

using namespace support;

/// A corner flies at a corner, along the diagonal as far as its velocity tells: gravity makes it pass the
/// line along it last, and that one it meets.
TEST(TrialStepCorners, TheMotionOfTheStepTellsWhichLineACornerMeets) {
  for (const bool downwards : {true, false}) {
    Scene scene = default_mechanics(0.02);
    scene.analysis.gravity = downwards ? Vec2(0, -10) : Vec2(-10, 0);
    scene.blocks = {block(rectangle(0, 0, 1, 1), true), block(rectangle(1.005, 1.005, 1, 1))};
    scene.blocks[1].velocity = {-0.4, -0.4};
    TrialOf step(scene);
    const TrialSolution solution = step.solve();
    ASSERT_TRUE(solution.rejection.empty());
    EXPECT_GT(step.counts.corner_solutions, 0);
    EXPECT_EQ(step.counts.unsettled_corners, 0);
    const auto pressed = [](const Contact& of) { return of.normal > 0; };
    ASSERT_EQ(std::ranges::count_if(step.trial.contacts(), pressed), 1);
    const Contact& contact = *std::ranges::find_if(step.trial.contacts(), pressed);
    EXPECT_EQ(contact.pair.edge % 2, downwards ? 1 : 0) << "edges 1 and 3 are upright";
    EXPECT_NEAR(contact.gap, 0, 1e-6);
    const Vec2 corner = step.blocks.block(1).vertex_map(0)(solution.motion());
    EXPECT_LT(downwards ? corner.y() : corner.x(), -0.009) << "past the other line";
  }
}

/// By the paper's preset the lines chosen at the start of a step stay.
TEST(TrialStepCorners, AreNotChosenAgainByThePapersPreset) {
  for (const Preset preset : {Preset::standard, Preset::paper}) {
    Scene scene = default_mechanics(0.02);
    scene.analysis.gravity = {0, -10};
    scene.analysis.preset = preset;
    scene.blocks = {block(rectangle(0, 0, 1, 1), true), block(rectangle(1.005, 1.005, 1, 1))};
    scene.blocks[1].velocity = {-0.4, -0.4};
    TrialOf step(scene);
    ASSERT_TRUE(step.solve().rejection.empty());
    EXPECT_EQ(step.counts.corner_solutions > 0, preset == Preset::standard);
  }
}
