#include <ddacontact/scene/unlikely_values.hpp>

#include <ddacontact/scene/text.hpp>

#include <cmath>
#include <numbers>

namespace ddacontact::scene_format {

namespace {

/// Degrees: joints with less friction are rarely meant, coefficients of friction are.
constexpr double largest_coefficient = 1.6;
/// m2: a bar of 25 cm.
constexpr double largest_section = 0.05;

}  // namespace

std::vector<std::string> notes_on_unlikely_values(const Scene& scene) {
  std::vector<std::string> notes;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const auto is_unlikely = [](const Joint& of) {
      return of.friction_angle > 0 && of.friction_angle < largest_coefficient;
    };
    Joint joint = scene.joints[j];
    for (const StageDescription& stage : scene.stages)
      if (is_unlikely(stage.joints[j])) joint = stage.joints[j];
    if (!is_unlikely(joint)) continue;
    const double angle = std::atan(joint.friction_angle) * 180 / std::numbers::pi;
    notes.push_back("the friction angle of joint " +
                    quoted(joint.name.empty() ? std::to_string(j) : joint.name) + " is " +
                    rounded(joint.friction_angle) + " degrees (as a coefficient of friction it would be " +
                    rounded(angle) + ")");
  }
  for (const RockBolt& bolt : scene.bolts)
    if (bolt.area > largest_section)
      notes.push_back("bolt " + quoted(bolt.name) + " has a section of " + rounded(bolt.area) +
                      " m2 (units may be stated: area = \"4 cm2\")");
  return notes;
}

}  // namespace ddacontact::scene_format
