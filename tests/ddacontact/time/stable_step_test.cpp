#include <ddacontact/block/corotational_shape.hpp>
#include <ddacontact/time/stable_step.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

Scene stepped_explicitly(double time_step, int steps) {
  Scene scene = default_mechanics(rock_scene(time_step, steps), Scheme::central_difference);
  return scene;
}

}  // namespace

TEST(StableStep, SubstepsAreNoLongerThanTheStiffestBlockAllows) {
  Scene scene = stepped_explicitly(1e-2, 1);
  scene.blocks = {block(rectangle(0, 0, 1, 1)), block(rectangle(3, 0, 0.5, 0.5))};
  const BuiltScene built = run(scene);
  const StableStep stable = *built.stepper->stable_step();
  EXPECT_EQ(stable.block, 1) << "the smaller one";
  EXPECT_EQ(stable.n_decaying, 0);
  EXPECT_NEAR(stable.critical, critical_step(*built.stepper->blocks().block(1).shape(), {}), 1e-15);
  EXPECT_EQ(built.stepper->counts().substeps, std::ceil(1e-2 / stable.dt));
  Scene decaying = scene;
  decaying.analysis.scheme = Scheme::decaying;
  EXPECT_FALSE(run(decaying).stepper->stable_step());
}

/// A block that is alone, or one of a few, is no sliver, and one that no step is short enough for stays as it
/// is where time_step is.
TEST(StableStep, FewBlocksVibrateAll) {
  Scene scene = stepped_explicitly(1e-6, 1);
  scene.blocks = {block(rectangle(0, 0, 1, 1)), block(rectangle(3, 0, 1, 0.01))};
  const StableStep stable = *run(scene).stepper->stable_step();
  EXPECT_EQ(stable.block, 1);
  EXPECT_EQ(stable.dt, 1e-6);
  EXPECT_EQ(stable.n_decaying, 0);
  scene.blocks = {block(rectangle(0, 0, 1, 1), true)};
  EXPECT_FALSE(run(scene).stepper->stable_step());
}

TEST(StableStep, DampingThatLeavesNoStepIsRefused) {
  Scene scene = stepped_explicitly(1e-3, 1);
  scene.analysis.damping.stiffness = 0.1;
  scene.blocks = {block(rectangle(0, 0, 1, 1))};
  EXPECT_THROW(build(scene), Error);
}

/// Of 41 blocks the third shortest step counts: blocks of less than a quarter of it decay.
TEST(StableStep, IsThatOfTheStiffestBlockThatIsNoSliver) {
  for (const double part : {0.3, 0.2}) {
    Scene scene = stepped_explicitly(1, 1);
    scene.blocks = {block(rectangle(0, 0, 1e-3, 1e-3), true)};
    for (int k = 0; k < 41; ++k) {
      const double side = k == 7 || k == 9 ? part : 1;
      scene.blocks.push_back(block(rectangle(3 + 2 * k, 0, side, side)));
    }
    const BuiltScene built = build(scene);
    const std::optional<StableStep> stable = find_stable_step(built.stepper->blocks(), scene.analysis);
    ASSERT_TRUE(stable);
    const double critical = critical_step(*built.stepper->blocks().block(stable->block).shape(), {});
    EXPECT_EQ(stable->critical, critical);
    EXPECT_NEAR(stable->dt, 0.9 * critical, 1e-15);
    EXPECT_EQ(built.stepper->blocks().block(stable->block).size() < 0.5, part > 0.25);
    EXPECT_EQ(stable->n_decaying, part > 0.25 ? 0 : 2);
    scene.analysis.mode = Mode::statics;
    EXPECT_FALSE(find_stable_step(built.stepper->blocks(), scene.analysis));
  }
}
