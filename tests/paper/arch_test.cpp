// Example 5.2: an arch of seven blocks under its weight and a load on the crown, inner radius 1 m.

#include <tests/support/run_scene.hpp>

namespace {

using namespace ddacontact;

constexpr double weight = 7 * 0.17227 * 2000 + 50;  // N per m, with the load

double largest_displacement(const Stepper& stepper) {
  return stepper.blocks().displacements(stepper.state()).colwise().norm().maxCoeff();
}

class Arch : public testing::TestWithParam<const char*> {
 protected:
  BuiltScene build(const std::string& name, std::vector<std::string> settings = {}) const {
    settings.push_back(std::string("analysis.block_model=") + GetParam());
    return support::build_example("paper/" + name + ".toml", settings);
  }
};

TEST_P(Arch, ConsistsOfSevenBlocksOfThePapersArea) {
  const BuiltScene built = build("arch_friction30");
  for (int b = 0; b < 7; ++b) EXPECT_NEAR(built.stepper->blocks().block(b).reference_area(), 0.17227, 1e-9);
}

TEST_P(Arch, StandsWithAFrictionAngleOf30Degrees) {
  BuiltScene built = build("arch_friction30");
  for (int i = 0; i < 300; ++i) {
    ASSERT_TRUE(built.stepper->step()) << built.stepper->stop_reason();
    ASSERT_LE(largest_displacement(*built.stepper), 0.01);  // 1 % of the radius
  }
  EXPECT_EQ(built.stepper->counts().unconverged, 0);
  EXPECT_EQ(built.stepper->counts().rejected, 0);
}

TEST_P(Arch, ItsSupportsCarryItsWeightAndTheLoad) {
  BuiltScene built = build("arch_friction30", {"analysis.mode=static"});
  ASSERT_TRUE(support::run(*built.stepper, 300));
  const Vec2 reaction = built.stepper->reactions().rowwise().sum();
  EXPECT_NEAR(reaction.x(), 0, 1e-6 * weight);
  EXPECT_NEAR(reaction.y(), weight, 1e-6 * weight);
}

TEST_P(Arch, FallsWithoutFriction) {
  BuiltScene built = build("arch_frictionless");
  ASSERT_TRUE(support::run(*built.stepper, 30)) << built.stepper->stop_reason();
  EXPECT_GE(largest_displacement(*built.stepper), 0.1);
  const Vec2 crown = observe(built.monitor_targets.front(), *built.stepper).velocity;
  EXPECT_LE(crown.y(), -1.0);  // and goes on falling
}

TEST_P(Arch, IsSymmetricAboutTheCrown) {
  BuiltScene built = build("arch_frictionless");
  ASSERT_TRUE(support::run(*built.stepper, 20));
  EXPECT_NEAR(observe(built.monitor_targets.front(), *built.stepper).displacement.x(), 0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(BothModels, Arch, testing::Values("wachspress", "affine"),
                         [](const testing::TestParamInfo<const char*>& model) {
                           return std::string(model.param);
                         });

}  // namespace
