#include "slope_factors.hpp"

#include <algorithm>
#include <cmath>

namespace jointed_rock {

StrengthReduction reduction_of(const Slope& slope) {
  Scene scene = slope.scene;
  scene.joints[0].friction_angle = degrees(known_factor * slope.limit);
  scene.analysis.time_step = time_step;
  scene.analysis.steps = static_cast<int>(std::lround(watched / time_step));
  return {scene, {0}};
}

double interlocked_factor(const Slope& slope) {
  return slope.limit /
         support::least_friction(support::interlocked(support::rigid_blocks(slope.scene))).value();
}

namespace {

bool has_face_of_limiting_dip(const Slope& slope) {
  const auto is_free = [&](int block) { return !slope.scene.blocks[static_cast<std::size_t>(block)].fixed; };
  return std::ranges::any_of(
      support::rigid_blocks(slope.scene).touching.points, [&](const support::ContactPoint& point) {
        const double tangent = std::abs(point.normal.x() / point.normal.y());
        return (is_free(point.one) || is_free(point.other)) && std::abs(tangent / slope.limit - 1) < 1e-5;
      });
}

}  // namespace

bool slid_on_a_plane(const Slope& slope, const StrengthTrial& trial) {
  if (!has_face_of_limiting_dip(slope)) return false;
  constexpr double aside = 0.1;
  std::vector<Eigen::Index> first_vertex{0};
  for (const BlockDescription& block : slope.scene.blocks)
    first_vertex.push_back(first_vertex.back() + block.vertices.cols());
  const Vec2 downhill = -Vec2(1, slope.limit).normalized();  // faces look to the left
  for (const int b : trial.moved_blocks)
    for (Eigen::Index v = first_vertex[b]; v < first_vertex[b + 1]; ++v) {
      const Vec2 moved = trial.displacements.col(v);
      if ((moved - moved.dot(downhill) * downhill).norm() > aside * moved.norm()) return false;
    }
  return !trial.moved_blocks.empty();
}

SlopeFactor factor_of(const Slope& slope, double tolerance) {
  const StrengthReduction reduction = reduction_of(slope);
  SlopeFactor result;
  result.interlocked = interlocked_factor(slope);
  double lowest = std::numeric_limits<double>::infinity();
  result.found = bracket_factor(
      [&](double factor) {
        const StrengthTrial trial = reduction.try_factor(factor);
        if (trial.verdict == ddacontact::Verdict::moves && factor < lowest) {
          lowest = factor;
          result.on_a_plane = slid_on_a_plane(slope, trial);
        }
        return trial.verdict;
      },
      std::nullopt, tolerance);
  result.found.low /= known_factor;
  result.found.high /= known_factor;
  return result;
}

StrengthTrial rounded_trial(const Slope& slope, const SlopeFactor& factor) {
  return try_with_rounded_corners(reduction_of(slope).scene(), {0}, factor.found.low * known_factor)
      .value()
      .trial;
}

}  // namespace jointed_rock
