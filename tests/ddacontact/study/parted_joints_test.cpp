// Factors of safety where a joint changes along a face.
#include "rock_on_joints.hpp"

namespace {

using namespace support;

/// A bridge of cohesive rock in a joint without strength, whose ends are vertices of both faces. Each part of
/// the face acts over its own length, wherever the bridge lies and from whichever side one counts.
TEST(StrengthReduction, ABridgeInAJointBearsItsCohesionOverItsLength) {
  constexpr double length = 6, cohesion = 1e5;
  for (const auto& [from, to] : {std::pair{2.9, 3.1}, {1., 2.}, {2., 4.}, {0., 3.}})
    for (const double sense : {1., -1.}) {
      SCOPED_TRACE(std::to_string(from) + " to " + std::to_string(sense * to));
      const auto x = [&, from = from, to = to](double at) { return sense > 0 ? at : length - at; };
      std::vector<double> ends{0, from, to, length};
      ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
      for (double& at : ends) at = x(at);
      std::ranges::sort(ends);
      const auto joint_at = [&, from = from, to = to](double middle) {
        return middle > std::min(x(from), x(to)) && middle < std::max(x(from), x(to)) ? 1 : 0;
      };
      Scene scene = rock({"open", 0, 0, 0, std::nullopt});
      scene.joints.push_back({"bridge", 0, cohesion, 0, std::nullopt});
      const auto n = static_cast<Eigen::Index>(ends.size());
      Points upper(2, n + 2), lower(2, n + 4);
      std::vector<int> of_upper, of_lower{0, 0, 0};
      for (Eigen::Index k = 0; k < n; ++k) upper.col(k) << ends[k], 0;
      upper.rightCols(2) << length, 0, 3, 3;
      lower.leftCols(3) << -5, 15, 15, -2, -2, 0;
      for (Eigen::Index k = 0; k < n; ++k) lower.col(3 + k) << ends[n - 1 - k], 0;
      lower.col(n + 3) << -5, 0;
      for (Eigen::Index k = 0; k + 1 < n; ++k) {
        of_upper.push_back(joint_at((ends[k] + ends[k + 1]) / 2));
        of_lower.push_back(joint_at((ends[n - 1 - k] + ends[n - 2 - k]) / 2));
      }
      of_upper.resize(static_cast<std::size_t>(n + 2), 0);
      of_lower.resize(static_cast<std::size_t>(n + 4), 0);
      add(scene, lower, true);
      add(scene, upper);
      scene.blocks[0].model = BlockModel::mean_value;
      scene.blocks[0].edge_joints = of_lower;
      scene.blocks[1].edge_joints = of_upper;
      Load load;
      load.block = 1;
      load.at = {length / 2, 0};
      load.force.value = {cohesion * (to - from), 0};
      scene.loads = {load};
      const StrengthReduction reduction(scene, {1});
      EXPECT_EQ(reduction.try_factor(0.98).verdict, Verdict::rests);
      EXPECT_EQ(reduction.try_factor(1.02).verdict, Verdict::moves);
    }
}

/// With vertices of both faces where the joint changes, elastic motion leads these apart and parts of the
/// face slip before the rest. Three vertices with the moment of the weight about the middle one, which has
/// the mean of both joints.
TEST(StrengthReduction, ABlockOnTwoJointsSlidesWhereTheirFrictionTogetherIsUsed) {
  constexpr double length = 6, height = 2, angle = 25;
  for (const BlockModel model : {BlockModel::affine, BlockModel::mean_value})
    for (const bool rougher_below : {true, false})
      for (const double sense : {1., -1.}) {
        SCOPED_TRACE(std::string(rougher_below ? "rougher below" : "smoother below") +
                     (sense > 0 ? "" : ", mirrored"));
        const double above = rougher_below ? 10 : 40, below = 50 - above;
        Scene scene = rock({"above", above, 0, 0, std::nullopt});
        scene.joints.push_back({"below", below, 0, 0, std::nullopt});
        const double slope = radians(angle);
        scene.analysis.gravity = 9.81 * Vec2(sense * std::sin(slope), -std::cos(slope));
        Points upper(2, 5), lower(2, 5);
        upper << -3, 0, 3, 3, -3,  //
            0, 0, 0, height, height;
        lower << -9, 9, 9, 0, -9,  //
            -2, -2, 0, 0, 0;
        add(scene, lower, true);
        add(scene, upper);
        const int left = sense > 0 ? 0 : 1, right = 1 - left;
        scene.blocks[0].edge_joints = {0, right, right, left, left};
        scene.blocks[1].edge_joints = {left, right, right, 0, left};
        scene.blocks[1].model = model;
        const auto tan_of = [](double degrees) { return std::tan(radians(degrees)); };
        const double off_middle = height / 2 * std::tan(slope) / (length / 2),
                     factor = ((tan_of(above) + tan_of(below)) / 2 +
                               (tan_of(below) - tan_of(above)) / 2 * off_middle) /
                              std::tan(slope);
        const StrengthReduction reduction(scene, {0, 1});
        EXPECT_EQ(reduction.try_factor(0.98 * factor).verdict, Verdict::rests);
        EXPECT_EQ(reduction.try_factor(1.02 * factor).verdict, Verdict::moves);
      }
}

/// The same on two blocks with a joint each: at their seam either corner may bear the force.
TEST(StrengthReduction, ABlockAcrossTheSeamOfTwoJointsUsesTheFrictionOfBoth) {
  constexpr double length = 10, height = 5, to_seam = 8, slope = 20, rough = 40, smooth = 10;
  // Pressure is linear under the resultant: weight through the centre, h / 2 tan(slope) down the slope of it.
  const double eccentricity = height / 2 * std::tan(radians(slope));
  const auto part_up_to = [&](double x) {  // of the normal force, from the upper end
    const double mean = x / length, skew = 6 * eccentricity / length;
    return mean + skew * mean * (mean - 1);
  };
  const auto tan_of = [](double degrees) { return std::tan(radians(degrees)); };
  for (const BlockModel model : {BlockModel::affine, BlockModel::mean_value})
    for (const double sense : {1., -1.}) {
      SCOPED_TRACE(sense);
      Scene scene = rock({"everywhere", rough, 0, 0, std::nullopt});
      scene.materials.push_back({"smooth", density, 5e9, 0.25});
      scene.joints.push_back({"smooth", smooth, 0, 0, std::nullopt});
      scene.joints[1].between = {{0, 1}};
      scene.analysis.gravity = gravity * Vec2(sense * std::sin(radians(slope)), -std::cos(radians(slope)));
      const auto place = [&](double from, double to) {
        return sense > 0 ? rectangle(from, -3, to - from, 3) : rectangle(length - to, -3, to - from, 3);
      };
      add(scene, place(-5, to_seam), true);
      add(scene, place(to_seam, 25), true);
      add(scene, rectangle(0, 0, length, height));
      scene.blocks[0].material = 1;
      scene.blocks[2].model = model;
      const double upper = part_up_to(to_seam),
                   factor = (upper * tan_of(smooth) + (1 - upper) * tan_of(rough)) / tan_of(slope);
      const StrengthReduction reduction(scene, {0, 1});
      EXPECT_EQ(reduction.try_factor(0.9 * factor).verdict, Verdict::rests);
      EXPECT_EQ(reduction.try_factor(1.1 * factor).verdict, Verdict::moves);
    }
}

/// Where the weak joint below a slab ends at its toe, its vertices slide a micrometre onto the strong one in
/// front of it: what stands on that is still weak. Either way round.
TEST(StrengthReduction, ASlabWhoseJointEndsAtItsToeHasTheFactorOfThatJoint) {
  constexpr double weak = 15, strong = 40, slope = 20;
  for (const double sense : {1., -1.}) {
    SCOPED_TRACE(sense);
    Scene scene = rock({"weak", weak, 0, 0, std::nullopt});
    scene.joints.push_back({"strong", strong, 0, 0, std::nullopt});
    scene.analysis.gravity = gravity * Vec2(sense * std::sin(radians(slope)), -std::cos(radians(slope)));
    const double toe = sense > 0 ? 10 : 0;
    Points lower(2, 5);
    lower << -10, 20, 20, toe, -10,  //
        -10, -10, 0, 0, 0;
    add(scene, lower, true);
    add(scene, rectangle(0, 0, 10, 2));
    const int right = sense > 0 ? 1 : 0, left = 1 - right;
    scene.blocks[0].edge_joints = {1, 1, right, left, 1};
    scene.blocks[1].edge_joints = {0, 0, 0, 0};
    const double exact = std::tan(radians(weak)) / std::tan(radians(slope));
    const StrengthReduction reduction(scene, {0, 1});
    EXPECT_EQ(reduction.try_factor(0.98 * exact).verdict, Verdict::rests);
    EXPECT_EQ(reduction.try_factor(1.02 * exact).verdict, Verdict::moves);
  }
}

}  // namespace
