// Example 5.3: Voronoi blocks with cohesion on a ramp, under gravity and pushed by 200 kN. Stresses and how
// both models agree: doc/verification/paper.md.

#include <ddacontact/detection/broad_phase.hpp>
#include <tests/support/overlap_area.hpp>
#include <tests/support/run_scene.hpp>

#include <algorithm>

namespace {

using namespace ddacontact;

constexpr int n_steps = 55;

BuiltScene run_example(const std::string& scene, const std::string& model) {
  BuiltScene built = support::build_example("paper/" + scene + ".toml", {"analysis.block_model=" + model});
  EXPECT_TRUE(support::run(*built.stepper, n_steps)) << built.stepper->stop_reason();
  return built;
}

Points outline(const Stepper& stepper, int b) {
  const Range& v = stepper.blocks().block(b).vertices();
  return stepper.blocks().positions(stepper.state()).middleCols(v.first, v.count);
}

class VoronoiSlope : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(VoronoiSlope, EveryStepSettlesAndBlocksHardlyOverlap) {
  const auto [scene, model] = GetParam();
  const BuiltScene built = run_example(scene, model);
  const Stepper& stepper = *built.stepper;
  EXPECT_EQ(stepper.counts().unconverged, 0);
  std::vector<Box> boxes;
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b) boxes.push_back(bounding_box(outline(stepper, b)));
  int n_touching = 0;
  for (const auto& [a, b] : overlapping_pairs(boxes)) {
    const double smaller =
        std::min(stepper.blocks().block(a).reference_area(), stepper.blocks().block(b).reference_area());
    EXPECT_LE(support::overlap_area(outline(stepper, a), outline(stepper, b)), 1e-4 * smaller)
        << a << " and " << b;
    ++n_touching;
  }
  EXPECT_GT(n_touching, 150);
}

INSTANTIATE_TEST_SUITE_P(BothModels, VoronoiSlope,
                         testing::Combine(testing::Values("voronoi_gravity", "voronoi_push"),
                                          testing::Values("wachspress", "affine")),
                         [](const auto& run) {
                           return std::string(std::get<0>(run.param)) + "_" + std::get<1>(run.param);
                         });

/// The ramp is all that holds the blocks: it carries their weight and the push.
TEST(VoronoiSlopeSupports, CarryTheWeightAndThePush) {
  constexpr double weight = 21e3 * (112 + 70);  // of the blocks and the ramp
  for (const auto& [scene, push] : {std::pair{"voronoi_gravity", 0.}, std::pair{"voronoi_push", 200e3}}) {
    const BuiltScene built = run_example(scene, "wachspress");
    const Vec2 reaction = built.stepper->reactions().rowwise().sum();
    EXPECT_NEAR(reaction.x(), -push, 1e-3 * weight) << scene;
    EXPECT_NEAR(reaction.y(), weight, 1e-3 * weight) << scene;
  }
}

}  // namespace
