// The examples of slopes and masonry against limit equilibrium and limit analysis.
#include <ddacontact/output/bolt_view.hpp>
#include <ddacontact/output/run_verdict.hpp>
#include <ddacontact/study/strength_reduction.hpp>
#include <tests/support/limit_analysis.hpp>
#include <tests/support/run_scene.hpp>

#include <fmt/format.h>
#include <Eigen/LU>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace ddacontact;

constexpr double degree = std::numbers::pi / 180;

Scene example(const std::string& name, const std::vector<std::string>& settings = {}) {
  SceneReading reading = read_scene(POLYDDA_EXAMPLES "/" + name, settings);
  for (const Problem& problem : reading.problems) ADD_FAILURE() << problem.text();
  return std::move(*reading.scene);
}

FactorBracket factor_of_safety(const Scene& scene) {
  std::vector<int> joints;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) joints.push_back(static_cast<int>(j));
  const StrengthReduction reduction(scene, joints);
  EXPECT_EQ(reduction.unsettled(), "");
  return bracket_factor([&](double f) { return reduction.try_factor(f).verdict; }, std::nullopt, 0.005);
}

void expect_within_a_percent(const FactorBracket& bracket, double exact) {
  EXPECT_NEAR(bracket.low, exact, 0.01 * exact);
  EXPECT_NEAR(bracket.high, exact, 0.01 * exact);
}

double weight_of(const Scene& scene, int block) {
  return scene.materials[scene.blocks[block].material].density * scene.analysis.gravity.norm() *
         std::abs(polyfem::signed_area(scene.blocks[block].vertices));
}

/// Free blocks, by the height of their lowest vertex.
std::vector<int> free_blocks(const Scene& scene) {
  std::vector<int> found;
  for (int b = 0; b < static_cast<int>(scene.blocks.size()); ++b)
    if (!scene.blocks[b].fixed) found.push_back(b);
  std::ranges::sort(found, {}, [&](int b) { return scene.blocks[b].vertices.row(1).minCoeff(); });
  return found;
}

TEST(Examples, PlaneFailureHasTheFactorOfHoekAndBray) {
  const Scene scene = example("plane_failure.toml");
  const double length = std::hypot(20, 14), dip = std::atan2(14, 20);
  const std::vector<int> blocks = free_blocks(scene);
  ASSERT_EQ(blocks.size(), 1u);
  const double weight = weight_of(scene, blocks[0]);
  const Joint& bedding = scene.joints[0];
  const double exact =
      (bedding.cohesion * length + weight * std::cos(dip) * std::tan(bedding.friction_angle * degree)) /
      (weight * std::sin(dip));
  EXPECT_NEAR(exact, 1.196, 5e-4);
  expect_within_a_percent(factor_of_safety(scene), exact);
}

/// What holds the lower of the two blocks back beyond friction when all faces slide: it and the wedge are
/// each in equilibrium under their weights, two planes and the vertical face between them.
double force_to_hold(double lower_weight, double wedge_weight, double friction) {
  const double flat = std::atan2(1, 10), steep = std::atan2(12.6 + 1.2, 11.5);
  const auto reaction = [&](double angle) {
    return Vec2(-std::sin(angle) + friction * std::cos(angle), std::cos(angle) + friction * std::sin(angle));
  };
  Eigen::Matrix2d of_wedge, of_lower;
  const Vec2 between(1, friction);  // on the wedge
  of_wedge << reaction(steep), between;
  const Vec2 forces = of_wedge.inverse() * Vec2(0, wedge_weight);
  of_lower << reaction(flat), Vec2(std::cos(flat), std::sin(flat));
  return (of_lower.inverse() * (Vec2(0, lower_weight) + forces.y() * between)).y();
}

TEST(Examples, WedgeBetweenTwoJointsHasTheFactorOfLimitEquilibrium) {
  const Scene scene = example("two_wedges.toml");
  const std::vector<int> blocks = free_blocks(scene);
  ASSERT_EQ(blocks.size(), 2u);
  double low = 0.5, high = 5;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2, friction = std::tan(scene.joints[0].friction_angle * degree);
    const bool moves =
        force_to_hold(weight_of(scene, blocks[0]), weight_of(scene, blocks[1]), friction / middle) > 0;
    (moves ? high : low) = middle;
  }
  EXPECT_NEAR(low, 1.914, 5e-4);
  expect_within_a_percent(factor_of_safety(scene), low);
}

/// Limit analysis lets sliding joints dilate by their friction angle. The factor lies between 3 % below it
/// and 1 % above.
TEST(Examples, SlopeWithTwoJointSetsHasTheFactorOfLimitAnalysis) {
  const Scene scene = example("slope_two_sets.toml");
  const std::optional<double> friction = support::least_friction(support::rigid_blocks(scene));
  ASSERT_TRUE(friction);
  const double limit = std::tan(scene.joints[0].friction_angle * degree) / *friction;
  EXPECT_NEAR(limit, 1.169, 1e-3);
  const StrengthReduction reduction(scene, {0, 1});
  EXPECT_EQ(reduction.unsettled(), "");
  EXPECT_EQ(reduction.try_factor(0.97 * limit).verdict, Verdict::rests);
  EXPECT_EQ(reduction.try_factor(1.01 * limit).verdict, Verdict::moves);
}

/// Whether a static run comes to rest in the shape that the scene has.
bool stands(const Scene& scene) {
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  while (!stepper.is_at_rest() && stepper.counts().steps < scene.analysis.steps)
    if (!stepper.step()) return false;
  return stepper.is_at_rest() && std::ranges::none_of(warnings_of(stepper), [](const std::string& warning) {
           return warning.find("no equilibrium") != std::string::npos;
         });
}

/// The limit of the load by limit analysis, and what the runs say at a part of it and 1 % beyond.
void expect_limit(const std::string& name, const std::string& parameter, double load, double known_limit,
                  double part_that_stands) {
  const auto loaded = [&](double value) {
    return example(name, {fmt::format("parameters.{}={:.17g}", parameter, value)});
  };
  const Scene scene = loaded(load);
  const std::optional<double> factor = support::largest_factor(
      support::rigid_blocks(scene), std::tan(scene.joints[0].friction_angle * degree));
  ASSERT_TRUE(factor);
  const double limit = *factor * load;
  EXPECT_NEAR(limit, known_limit, 1e-3 * std::abs(known_limit));
  EXPECT_TRUE(stands(loaded(part_that_stands * limit)));
  EXPECT_FALSE(stands(loaded(1.01 * limit)));
}

TEST(Examples, ArchFailsAtTheLoadOfLimitAnalysis) {
  expect_limit("arch_quarter_load.toml", "load", -10e3, -85.30e3, 0.99);
}

/// Without bolts two blocks at the crown fall.
TEST(Examples, TunnelStandsByItsBolts) {
  const auto largest_motion = [](const BuiltScene& built) {
    return built.stepper->blocks().displacements(built.stepper->state()).colwise().norm().maxCoeff();
  };
  const auto run = [](const Scene& scene) {
    BuiltScene built = build(scene);
    Stepper& stepper = *built.stepper;
    while (stepper.stage() < 2 || (!stepper.is_at_rest() && stepper.counts().steps < 93))
      if (!stepper.step()) break;
    EXPECT_EQ(stepper.stop_reason(), "");
    return built;
  };
  const BuiltScene bolted = run(example("tunnel_bolts.toml"));
  EXPECT_TRUE(bolted.stepper->is_at_rest());
  EXPECT_LT(largest_motion(bolted), 1e-3);
  double force = 0;
  const BlockSystem& blocks = bolted.stepper->blocks();
  for (const Bolt& bolt : blocks.bolts)
    for (int k = 0; k + 1 < static_cast<int>(bolt.nodes.size()); ++k)
      force = std::max(force, BoltView(bolt, blocks, bolted.stepper->state()).axial(k));
  EXPECT_NEAR(force, 21.1e3, 2e3);
  const BuiltScene loose = run(example("tunnel_bolts.toml", {"parameters.bond=1"}));
  EXPECT_FALSE(loose.stepper->is_at_rest());
  EXPECT_GT(largest_motion(loose), 1);
}

/// Bricks slide on each other, which makes limit analysis an upper bound.
TEST(Examples, WallWithADoorFailsBelowThePushOfLimitAnalysis) {
  expect_limit("wall_door.toml", "push", 3e3, 10.52e3, 0.9);
}

}  // namespace
