#include <ddacontact/study/rounded_trial.hpp>

#include <ddacontact/block/rounded_corners.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr double part_of_factor = 0.95, usual_rounding = 0.003;
/// Of what the shortest edge allows.
constexpr double most_of_edge = 0.5;

bool may_be_rounded(const Scene& scene) {
  const auto has_crushed_joints = [](const auto& part) {
    return std::ranges::any_of(part.joints,
                               [](const Joint& joint) { return joint.compressive_strength > 0; });
  };
  return scene.contact.corner_rounding == 0 && scene.contact.method == ContactMethod::staged &&
         scene.analysis.preset != Preset::paper && !has_crushed_joints(scene) &&
         std::ranges::none_of(scene.stages, has_crushed_joints);
}

double rounding_of(const Scene& scene) {
  double rounding = usual_rounding;
  for (const BlockDescription& block : scene.blocks) {
    const double size = std::sqrt(std::abs(polyfem::signed_area(block.vertices)));
    rounding = std::min(rounding, most_of_edge * largest_rounding(block.vertices).radius / size);
  }
  return rounding;
}

}  // namespace

std::optional<RoundedTrial> try_with_rounded_corners(Scene scene, const std::vector<int>& joints,
                                                     double factor) {
  if (!may_be_rounded(scene)) return std::nullopt;
  RoundedTrial rounded{.rounding = rounding_of(scene), .trial = {}};
  scene.contact.corner_rounding = rounded.rounding;
  try {
    const StrengthReduction reduction(scene, joints);
    rounded.trial = reduction.try_factor(part_of_factor * factor);
  } catch (const SettlingStopped& stopped) {
    rounded.trial.factor = part_of_factor * factor;
    rounded.trial.reason = stopped.what();
  }
  return rounded;
}

}  // namespace ddacontact
