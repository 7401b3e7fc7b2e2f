/// \file The scenes of examples/practice, each against what is known of it.
#include <tests/support/run_scene.hpp>

#include <ddacontact/study/factor_bracket.hpp>
#include <ddacontact/study/strength_reduction.hpp>
#include <ddacontact/time/probe.hpp>

namespace {

using namespace ddacontact;

Vec2 travel_of(const BuiltScene& built, const std::string& monitor) {
  for (const Probe& probe : built.probes)
    if (probe.name == monitor) return observe(probe, *built.stepper).displacement;
  throw std::runtime_error("no monitor " + monitor);
}

}  // namespace

/// The factor of limit equilibrium in the scene's first lines.
TEST(Practice, DamSlidesAtItsFactorOfSafety) {
  const SceneReading reading = read_scene(POLYDDA_EXAMPLES "/practice/dam.toml", {});
  ASSERT_TRUE(reading.scene);
  const StrengthReduction reduction(*reading.scene, {0});
  EXPECT_EQ(reduction.unsettled(), "");
  const FactorBracket bracket = bracket_factor([&](double f) { return reduction.try_factor(f).verdict; }, std::nullopt, 0.004);
  const double exact = (4233.6 + 11.76 - 1470) / (1587.6 - 19.6);
  EXPECT_NEAR(bracket.low, exact, 0.005 * exact);
  EXPECT_NEAR(bracket.high, exact, 0.005 * exact);
}

/// Half and a quarter of the step agree on how far the top of the column has moved, and the energy that the
/// ground put in is accounted for.
TEST(Practice, DrumsAnswerTheSameInShorterSteps) {
  std::vector<Vec2> travels;
  for (const char* refined : {"1", "2"}) {
    const int factor = std::atoi(refined);
    BuiltScene built = support::build_example(
        "practice/drums.toml",
        {"analysis.time_step=" + std::to_string(0.0025 / factor), "stage.shake.steps=" + std::to_string(3200 * factor),
         "stage.settle.steps=" + std::to_string(10 * factor)});
    ASSERT_TRUE(support::run(*built.stepper, 3210 * factor)) << built.stepper->stop_reason();
    travels.push_back(travel_of(built, "top"));
    EXPECT_LT(std::abs(travels.back().x()), 1);
  }
  std::cout << travels[0].transpose() << " / " << travels[1].transpose() << '\n';
  EXPECT_NEAR((travels[0] - travels[1]).norm(), 0, 0.01 * travels[1].norm());
}

/// Boulders come to rest below where they began, and fall no further than the foot.
TEST(Practice, RocksComeToRestOnTheBenches) {
  BuiltScene built = support::build_example("practice/rockfall.toml");
  ASSERT_TRUE(support::run(*built.stepper, 2000)) << built.stepper->stop_reason();
  EXPECT_TRUE(built.stepper->is_at_rest());
  for (const char* name : {"boulder", "slab", "cobble"}) {
    const Vec2 travel = travel_of(built, name);
    EXPECT_GT(travel.x(), 2) << name;
    EXPECT_LT(travel.y(), -5) << name;
    EXPECT_GT(travel.y(), -23) << name;
  }
}
