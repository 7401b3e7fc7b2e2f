// What a step leaves out where it has no effect: with it and without it results are the same to the bit.
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/any_drops.hpp>
#include <tests/support/made_scenes.hpp>
#include <tests/support/random_scenes.hpp>

#include <gtest/gtest.h>

#include <array>

using namespace ddacontact;

namespace {

BuiltScene after(const Scene& scene, int steps) {
  BuiltScene built = build(scene);
  for (int k = 0; k < steps && built.stepper->step(); ++k) {
  }
  return built;
}

/// All that a run leaves: the state, the contacts, the reactions, the energies and the counts, but for how
/// often was factorized where the skip is of that.
std::string bits_after(const Scene& scene, int steps, bool Skips::*skip) {
  RunRecord record = after(scene, steps).stepper->run_record();
  if (skip == &Skips::unchanged_factor) record.counts.factorizations = 0;
  return to_bytes(record);
}

Scene with(bool Skips::*skip, bool value, Scene scene) {
  scene.analysis.skip.*skip = value;
  for (StageDescription& stage : scene.stages) stage.analysis.skip.*skip = value;
  return scene;
}

void expect_no_effect(bool Skips::*skip, const Scene& scene, int steps, const std::string& name) {
  EXPECT_TRUE(bits_after(with(skip, true, scene), steps, skip) ==
              bits_after(with(skip, false, scene), steps, skip))
      << name;
}

void without_friction(Scene& scene) {
  for (Joint& joint : scene.joints) joint.friction_angle = joint.cohesion = joint.tensile_strength = 0;
}

/// Each edge in n parts.
Points with_parted_edges(const Points& outline, int n) {
  Points parted(2, n * outline.cols());
  for (Index v = 0; v < outline.cols(); ++v)
    for (int part = 0; part < n; ++part)
      parted.col(n * v + part) =
          outline.col(v) + part * (outline.col((v + 1) % outline.cols()) - outline.col(v)) / n;
  return parted;
}

/// Held and free blocks of all kinds, some of them with stress, each free one on two that are held; the last
/// held one goes away after some steps.
Scene many_held(bool corotational) {
  Scene scene = support::rock_scene(0.01, 8);
  if (corotational) {
    scene = support::default_mechanics(scene);
  }
  scene.joints[0].friction_angle = 20;
  const std::vector<BlockModel> models{BlockModel::wachspress, BlockModel::affine, BlockModel::mean_value,
                                       corotational ? BlockModel::mesh : BlockModel::affine};
  const auto add = [&](const Points& outline, bool fixed) {
    scene.blocks.push_back(support::block(support::turned(outline, 0.1), fixed));
    BlockDescription& block = scene.blocks.back();
    block.model = models[scene.blocks.size() % models.size()];
    if (scene.blocks.size() % 3 == 0) block.stress = {1e4, -2e4, 5e3};
  };
  for (int k = 0; k < 8; ++k) add(support::rectangle(1.1 * k, -1, 1, 1), true);
  for (int k = 0; k < 7; ++k) add(support::rectangle(1.1 * k + 0.5, 0, 1, 0.7), false);
  for (int k = 0; k < 5; ++k) add(support::rectangle(1.1 * k + 1, 0.75, 1, 0.7), false);
  scene.loads = {support::body_load(2, support::constant({0, -1e3})), support::pressure_load(1, 2, 1e4)};
  for (const bool later : {false, true}) {
    StageDescription stage = scene.stage("");
    stage.analysis.steps = 4;
    if (later) stage.removed = {7};
    scene.stages.push_back(stage);
  }
  return scene;
}

class Skip : public testing::TestWithParam<bool Skips::*> {};

TEST_P(Skip, HasNoEffectOnMadeScenes) {
  for (auto [name, scene] : support::made_scenes()) {
    expect_no_effect(GetParam(), scene, 6, name);
    without_friction(scene);
    expect_no_effect(GetParam(), scene, 6, name + " without friction");
  }
}

TEST_P(Skip, HasNoEffectOnTheMechanicsOfThePaper) {
  for (const auto& [name, scene] : support::made_scenes()) {
    Scene of_paper = support::paper_mechanics(scene);
    if (scene.analysis.mode == Mode::statics) of_paper.analysis.scheme = scene.analysis.scheme;
    expect_no_effect(GetParam(), of_paper, 4, name);
  }
}

TEST_P(Skip, HasNoEffectOnRandomScenes) {
  for (std::uint64_t seed = 1000; seed < 1000 + 3 * support::n_drop_kinds; ++seed) {
    Scene scene = support::random_drop(seed);
    if (seed % 2 == 0) without_friction(scene);
    expect_no_effect(GetParam(), scene, 8, "seed " + std::to_string(seed));
  }
}

TEST_P(Skip, HasNoEffectOnDropsOfAnyShape) {
  for (std::uint64_t seed = 0; seed < 2 * support::n_grounds; ++seed)
    expect_no_effect(GetParam(), support::any_drop(seed), 8, "seed " + std::to_string(seed));
}

/// Motion is local, and solved for without a factor where blocks have few vertices: all but the held ones.
TEST_P(Skip, HasNoEffectInShortSteps) {
  long sweeps = 0;
  for (std::uint64_t seed = 1000; seed < 1000 + 2 * support::n_drop_kinds; ++seed) {
    Scene scene = support::random_drop(seed);
    scene.analysis.time_step = 1e-5;
    scene.analysis.skip.islands = false;
    for (BlockDescription& block : scene.blocks)
      if (block.fixed) block = support::block(with_parted_edges(block.vertices, 3), true);
    for (BlockDescription& block : scene.blocks)
      block.model = block.fixed ? BlockModel::mean_value : BlockModel::wachspress;
    expect_no_effect(GetParam(), scene, 8, "seed " + std::to_string(seed));
    sweeps += after(scene, 8).stepper->counts().sweeps;
  }
  EXPECT_GT(sweeps, 0);
}

TEST_P(Skip, HasNoEffectOnManyHeldBlocks) {
  for (const bool corotational : {false, true})
    EXPECT_EQ(after(many_held(corotational), 8).stepper->counts().steps, 8);
  for (const bool corotational : {false, true})
    for (const bool islands : {false, true})
      expect_no_effect(
          GetParam(), with(&Skips::islands, islands, many_held(corotational)), 8,
          std::string(corotational ? "corotational" : "incremental") + (islands ? ", islands apart" : ""));
}

std::string name_of(const testing::TestParamInfo<bool Skips::*>& skip) {
  return std::array{"FrictionRows", "Congruent", "FixedBlocks", "UnchangedFactor", "Skin"}[skip.index];
}
INSTANTIATE_TEST_SUITE_P(OfTheSameBits, Skip,
                         testing::Values(&Skips::friction_rows, &Skips::congruent, &Skips::fixed_blocks,
                                         &Skips::unchanged_factor, &Skips::skin),
                         name_of);

/// Open-close iterations solve the same matrix again; the default mechanics turns it with the blocks first.
TEST(UnchangedFactor, SavesFactorizationsOfThePaper) {
  const auto factorizations = [](bool kept) {
    long sum = 0;
    for (const auto& [name, scene] : support::made_scenes())
      sum += after(with(&Skips::unchanged_factor, kept, support::paper_mechanics(scene)), 6)
                 .stepper->counts()
                 .factorizations;
    return sum;
  };
  EXPECT_LT(factorizations(true), factorizations(false));
}

}  // namespace
