#include <ddacontact/time/motion_limits.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

Scene falling_blocks(Preset preset) {
  Scene scene = rock_scene(0.05, 20);
  scene.analysis.preset = preset;
  scene.blocks = {block(rectangle(0, 0, 1, 1)), block(rectangle(3, 0, 0.25, 0.25)),
                  block(rectangle(9, 0, 1, 1), true)};
  scene.blocks[1].velocity = {0, 1};
  return scene;
}

}  // namespace

TEST(MotionLimits, ShisLimitIsThatPartOfHalfTheLargerSideOfTheScene) {
  const Scene scene = falling_blocks(Preset::standard);
  const BuiltScene built = build(scene);
  EXPECT_DOUBLE_EQ(MotionLimits(built.stepper->blocks(), scene.analysis).largest_displacement(),
                   0.1 * 10 / 2);
}

/// In the default preset no vertex moves further in a substep than contacts were looked for, in none than
/// Shi's limit.
TEST(MotionLimits, NoVertexOutrunsItsLimitInASubstep) {
  for (Preset preset : {Preset::standard, Preset::paper}) {
    Scene scene = falling_blocks(preset);
    const BuiltScene built = build(scene);
    MotionLimits limits(built.stepper->blocks(), scene.analysis);
    long substeps = 0;
    Points before = built.stepper->blocks().positions(built.stepper->state());
    double furthest = 0;
    for (int k = 0; k < 20; ++k) {
      run(*built.stepper, 1);
      const Points now = built.stepper->blocks().positions(built.stepper->state());
      const long taken = built.stepper->counts().substeps - substeps;
      furthest = (now - before).middleCols(4, 4).colwise().norm().maxCoeff() / static_cast<double>(taken);
      EXPECT_LE(furthest, limits.largest_search_margin(built.stepper->blocks().block(1)));
      substeps += taken;
      before = now;
    }
    EXPECT_DOUBLE_EQ(limits.largest_search_margin(built.stepper->blocks().block(1)),
                     preset == Preset::paper ? 0.5 : 0.0625);
    EXPECT_GT(furthest, 0.3 * limits.largest_search_margin(built.stepper->blocks().block(1)));
  }
}

TEST(MotionLimits, ReachCoversTheMotionForeseenAndHeldBlocksNone) {
  const Scene scene = falling_blocks(Preset::standard);
  const BuiltScene built = build(scene);
  MotionLimits limits(built.stepper->blocks(), scene.analysis);
  const auto search_margin =
      limits.search_margin(built.stepper->blocks(), built.stepper->state(), {}, 0.01, 1);
  EXPECT_GT(search_margin[1], 0.01);
  EXPECT_GT(search_margin[0], 0.0005);
  EXPECT_EQ(search_margin[2], 0);
  EXPECT_GT(limits.search_margin(built.stepper->blocks(), built.stepper->state(), {}, 0.01, 2)[1],
            1.9 * search_margin[1]);
  EXPECT_LE(limits.search_margin(built.stepper->blocks(), built.stepper->state(), {}, 0.01, 1e9)[1],
            limits.largest_search_margin(built.stepper->blocks().block(1)));
  const double t = limits.predicted_step(built.stepper->blocks(), built.stepper->state(), {});
  EXPECT_NEAR(1 * t + scene.analysis.gravity.norm() * t * t / 2, 0.9 * 0.0625, 1e-12);
}
