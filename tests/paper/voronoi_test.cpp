// Example 5.3: Voronoi blocks with cohesion on a ramp, under gravity and pushed by 200 kN.

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/output/block_summary.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/overlap_area.hpp>
#include <tests/support/run_scene.hpp>

#include <algorithm>
#include <cmath>

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

/// Area-weighted mean of the block averages of sigma_2 in rows of equal height, from the top down.
TEST(VoronoiSlopeStress, IsCompressiveAndGrowsWithDepthRowByRow) {
  for (const char* model : {"wachspress", "affine"}) {
    const BuiltScene built = run_example("voronoi_gravity", model);
    const Stepper& stepper = *built.stepper;
    constexpr int n_rows = 6;
    constexpr double top = 10.5, bottom = 1.5;
    std::array<double, n_rows> sum{}, area{};
    for (int b = 1; b < stepper.blocks().n_blocks(); ++b) {
      const Block& block = stepper.blocks().block(b);
      const double s2 = polyfem::principal_stresses(stress_range(block, stepper.state()).mean).s2;
      EXPECT_LT(s2, 0) << model << ", block " << b;
      const int row = static_cast<int>(n_rows * (top - block.centroid().y()) / (top - bottom));
      sum[row] += s2 * block.moments().area;
      area[row] += block.moments().area;
    }
    for (int row = 1; row < n_rows; ++row)
      EXPECT_LT(sum[row] / area[row], sum[row - 1] / area[row - 1]) << model;
  }
}

TEST(VoronoiSlopeConfigurations, OfBothModelsAgreeWithinOnePercentOfABlocksSize) {
  for (const char* scene : {"voronoi_gravity", "voronoi_push"}) {
    const BuiltScene wachspress = run_example(scene, "wachspress"), affine = run_example(scene, "affine");
    for (int b = 1; b < wachspress.stepper->blocks().n_blocks(); ++b) {
      const double apart =
          (outline(*wachspress.stepper, b) - outline(*affine.stepper, b)).colwise().norm().maxCoeff();
      EXPECT_LE(apart, 0.01 * wachspress.stepper->blocks().block(b).size()) << scene << ", block " << b;
    }
  }
}

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
