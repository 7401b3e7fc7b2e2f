// Scenes drawn by lot: the margin that pairs of blocks are kept with changes no bit of a run, nor do threads.

#include <ddacontact/scene/builder.hpp>
#include <polyfem/core/parallel.hpp>
#include <tests/support/any_drops.hpp>
#include <tests/support/random_scenes.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;
using namespace support;

namespace {

/// The first half of the steps, then the rest with a block taken out.
Scene in_two_stages(Scene scene, int steps, bool skin) {
  for (const int first : {0, steps / 2}) {
    StageDescription stage = scene.stage("");
    stage.analysis.steps = first == 0 ? steps / 2 : steps - first;
    stage.analysis.skip.skin = skin;
    if (first > 0) stage.removed = {static_cast<int>(scene.blocks.size()) - 1};
    scene.stages.push_back(stage);
  }
  return scene;
}

std::string bytes_after_a_run(const Scene& scene, int steps, bool skin, int threads) {
  polyfem::set_threads(threads);
  const BuiltScene built = build(in_two_stages(scene, steps, skin));
  for (int k = 0; k < steps; ++k)
    if (!built.stepper->step()) break;
  polyfem::set_threads(1);
  return to_bytes(built.stepper->run_record());
}

}  // namespace

TEST(ContactSkin, ChangesNoBitOfRandomScenes) {
  for (std::uint64_t seed = 0; seed < 3 * n_drop_kinds; ++seed) {
    SCOPED_TRACE(name_of(drop_kind(seed)) + ' ' + std::to_string(seed));
    const Scene scene = random_drop(seed);
    const std::string without = bytes_after_a_run(scene, 12, false, 1);
    EXPECT_TRUE(bytes_after_a_run(scene, 12, true, 1) == without);
  }
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = any_drop(seed);
    EXPECT_TRUE(bytes_after_a_run(scene, 12, true, 1) == bytes_after_a_run(scene, 12, false, 1));
  }
}
