// What a step leaves out where it has no effect: with it and without it results are the same to the bit.
#include <ddacontact/scene/builder.hpp>
#include <tests/support/made_scenes.hpp>
#include <tests/support/random_scenes.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

/// All that a run leaves: the state, the contacts, the reactions, the energies and the counts.
std::string bits_after(const Scene& scene, int steps) {
  const BuiltScene built = build(scene);
  for (int k = 0; k < steps && built.stepper->step(); ++k) {
  }
  return to_bytes(built.stepper->run_record());
}

void expect_no_effect(bool Skips::*skip, Scene scene, int steps, const std::string& name) {
  scene.analysis.skip.*skip = true;
  const std::string with = bits_after(scene, steps);
  scene.analysis.skip.*skip = false;
  EXPECT_TRUE(with == bits_after(scene, steps)) << name;
}

void without_friction(Scene& scene) {
  for (Joint& joint : scene.joints) joint.friction_angle = joint.cohesion = joint.tensile_strength = 0;
}

class Skip : public testing::TestWithParam<bool Skips::*> {};

TEST_P(Skip, HasNoEffectOnMadeScenes) {
  for (auto [name, scene] : support::made_scenes()) {
    expect_no_effect(GetParam(), scene, 6, name);
    without_friction(scene);
    expect_no_effect(GetParam(), scene, 6, name + " without friction");
  }
}

TEST_P(Skip, HasNoEffectOnRandomScenes) {
  for (std::uint64_t seed = 1000; seed < 1000 + 3 * support::n_drop_kinds; ++seed) {
    Scene scene = support::random_drop(seed);
    if (seed % 2 == 0) without_friction(scene);
    expect_no_effect(GetParam(), scene, 8, "seed " + std::to_string(seed));
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheSameBits, Skip, testing::Values(&Skips::friction_rows, &Skips::congruent),
                         [](const auto& skip) { return skip.index == 0 ? "FrictionRows" : "Congruent"; });

}  // namespace
