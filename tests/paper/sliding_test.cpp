// Example 5.1: a block slides down a ramp. The answer for a rigid block is (53), v = g
// t (sin a - cos a tan phi).

#include <tests/support/run_scene.hpp>

#include <cmath>
#include <numbers>
#include <tuple>

namespace {

using namespace ddacontact;

constexpr int n_steps = 35;
constexpr double end_time = 0.7, g = 9.8;
constexpr int slider = 1;

double exact_velocity(double friction_angle) {
  const double a = std::numbers::pi / 4, phi = friction_angle * std::numbers::pi / 180;
  return g * end_time * (std::sin(a) - std::cos(a) * std::tan(phi));
}

/// Momentum over mass, along the slope of 45 degrees.
double velocity_along_slope(const Stepper& stepper) {
  const Vec2 v = rigid_velocity(stepper.blocks().block(slider), stepper.state().velocity).linear;
  return v.dot(Vec2(1, -1).normalized());
}

std::string scene(int friction_angle) {
  return "paper/sliding_" + std::to_string(friction_angle) + ".toml";
}

using Case = std::tuple<int, const char*, const char*>;  // friction angle, model, Young's modulus
class Sliding : public testing::TestWithParam<Case> {};

std::string case_name(const testing::TestParamInfo<Case>& info) {
  const auto [angle, model, young] = info.param;
  return std::to_string(angle) + "Degrees_" + model + "_E" + std::string(young).substr(0, 2) +
         std::string(young).substr(3);
}

TEST_P(Sliding, FollowsTheRigidBlocksVelocity) {
  const auto [angle, model, young] = GetParam();
  const bool stiff = young == std::string("35 GPa");
  for (const char* preset : {"paper", "default"}) {
    BuiltScene built = support::build_example(scene(angle), {std::string("analysis.block_model=") + model,
                                                             std::string("material.rock.young=") + young,
                                                             std::string("analysis.preset=") + preset});
    Stepper& stepper = *built.stepper;
    ASSERT_TRUE(support::run(stepper, n_steps)) << stepper.stop_reason();
    const double error = velocity_along_slope(stepper) / exact_velocity(angle) - 1;
    RecordProperty(std::string("relative_error_") + preset, std::to_string(error));
    EXPECT_LE(std::abs(error), stiff ? 2e-4 : 1e-3) << preset;
    EXPECT_EQ(stepper.counts().unconverged, 0);
    EXPECT_EQ(stepper.counts().rejected, 0);
    EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Stiff, Sliding,
                         testing::Combine(testing::Values(0, 15, 30, 40),
                                          testing::Values("wachspress", "affine"), testing::Values("35 GPa")),
                         case_name);
INSTANTIATE_TEST_SUITE_P(Soft, Sliding,
                         testing::Combine(testing::Values(0, 15, 30), testing::Values("wachspress", "affine"),
                                          testing::Values("35 MPa")),
                         case_name);

// The soft block at 40 degrees vibrates (friction couples its normal and tangential modes, and gravity is
// sudden): its velocity is that of the rigid block only on the whole. See doc/paper_map.md.
TEST(SlidingSoft, At40DegreesVibratesAboutTheRigidBlocksVelocity) {
  for (const char* model : {"wachspress", "affine"}) {
    BuiltScene built = support::build_example(scene(40), {std::string("analysis.block_model=") + model});
    ASSERT_TRUE(support::run(*built.stepper, n_steps));
    EXPECT_NEAR(velocity_along_slope(*built.stepper) / exact_velocity(40), 1, 0.1) << model;
  }
}

struct Slope {
  double slope, friction, width, height;  // degrees, m
};
class OtherSlopes : public testing::TestWithParam<Slope> {};

/// A block of rock (E = 35 GPa) on a ramp of its own slope.
Scene slope_scene(const Slope& s, BlockModel model) {
  const double a = s.slope * std::numbers::pi / 180;
  const Vec2 t(std::cos(a), -std::sin(a)), n(std::sin(a), std::cos(a));
  const double length = 3 * s.width + g * end_time * end_time;
  const Vec2 top(0, length * std::sin(a)), corner = top + s.width / 2 * t;
  Scene scene;
  scene.analysis.steps = n_steps;
  scene.analysis.time_step = end_time / n_steps;
  scene.materials = {{"rock", 2500, 35e9, 0.3}};
  scene.joints = {{"interface", s.friction, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * 35e9;
  scene.contact.tangential_stiffness = 16 * 35e9;
  scene.blocks.resize(2);
  scene.blocks[0].vertices.resize(2, 3);
  scene.blocks[0].vertices << Vec2(0, 0), Vec2(top + length * t), top;
  scene.blocks[0].fixed = true;
  scene.blocks[slider].vertices.resize(2, 4);
  scene.blocks[slider].vertices << corner, Vec2(corner + s.width * t),
      Vec2(corner + s.width * t + s.height * n), Vec2(corner + s.height * n);
  for (BlockDescription& block : scene.blocks) block.model = model;
  return scene;
}

TEST_P(OtherSlopes, FollowTheRigidBlocksVelocity) {
  const Slope& s = GetParam();
  const double a = s.slope * std::numbers::pi / 180;
  const double exact =
      g * end_time * (std::sin(a) - std::cos(a) * std::tan(s.friction * std::numbers::pi / 180));
  for (BlockModel model : {BlockModel::wachspress, BlockModel::affine}) {
    const BuiltScene built = build(slope_scene(s, model));
    ASSERT_TRUE(support::run(*built.stepper, n_steps)) << built.stepper->stop_reason();
    const Vec2 v =
        rigid_velocity(built.stepper->blocks().block(slider), built.stepper->state().velocity).linear;
    EXPECT_NEAR(v.dot(Vec2(std::cos(a), -std::sin(a))) / exact, 1, 2e-4);
    EXPECT_EQ(built.stepper->counts().unconverged, 0);
  }
}

// Gentle and steep, flat and near toppling, small against the step's motion and large. (A block of 2 cm near
// toppling, on a ramp of 5 m, is at the round-off floor of penalty times coordinate, 0.6 % of its
// weight: 2.7e-4.)
INSTANTIATE_TEST_SUITE_P(Sliding, OtherSlopes,
                         testing::Values(Slope{20, 10, 4, 2}, Slope{30, 0, 1, 1}, Slope{30, 20, 3, 0.5},
                                         Slope{45, 40, 1, 1}, Slope{60, 40, 4, 2}, Slope{60, 30, 0.02, 0.01},
                                         Slope{70, 40, 1, 1}, Slope{70, 55, 4, 2}));

}  // namespace
