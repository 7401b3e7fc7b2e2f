#include <ddacontact/study/variant_trials.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

constexpr double part_of_factor = 0.95, usual_rounding = 0.003;

/// Of a variant; without a verdict where it does not settle.
StrengthTrial try_part(const Scene& scene, const std::vector<int>& joints, double factor) {
  try {
    return StrengthReduction(scene, joints).try_factor(part_of_factor * factor);
  } catch (const SettlingStopped& stopped) {
    StrengthTrial trial;
    trial.factor = part_of_factor * factor;
    trial.reason = stopped.what();
    return trial;
  }
}

bool may_be_rounded(const Scene& scene) {
  const auto has_crushed_joints = [](const auto& part) {
    return std::ranges::any_of(part.joints,
                               [](const Joint& joint) { return joint.compressive_strength > 0; });
  };
  return scene.contact.corner_rounding == 0 && scene.contact.method == ContactMethod::staged &&
         scene.analysis.preset != Preset::paper && !has_crushed_joints(scene) &&
         std::ranges::none_of(scene.stages, has_crushed_joints);
}

}  // namespace

std::optional<RoundedTrial> try_with_rounded_corners(Scene scene, const std::vector<int>& joints,
                                                     double factor) {
  if (!may_be_rounded(scene)) return std::nullopt;
  scene.contact.corner_rounding = usual_rounding;
  return RoundedTrial{usual_rounding, try_part(scene, joints, factor)};
}

std::optional<StrengthTrial> try_without_swelling(Scene scene, const std::vector<int>& joints,
                                                  double factor) {
  const bool none = std::ranges::all_of(scene.materials, [](const Material& of) { return of.poisson == 0; });
  if (none || scene.analysis.preset == Preset::paper) return std::nullopt;
  for (Material& material : scene.materials) material.poisson = 0;
  return try_part(scene, joints, factor);
}

}  // namespace ddacontact
