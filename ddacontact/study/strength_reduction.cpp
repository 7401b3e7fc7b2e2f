#include <ddacontact/study/strength_reduction.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ddacontact {

namespace {

constexpr int fewest_settling_steps = 1000;

/// In two parts: settled while glued, then as it is.
Scene with_settling(Scene scene) {
  if (scene.contact.method == ContactMethod::classic)
    throw Error("a scene of one part settles glued, which the method \"classic\" cannot (write [[stage]]s)");
  StageDescription settling = scene.stage("settle"), own = scene.stage("");
  settling.analysis.mode = Mode::statics;
  settling.analysis.steps = std::max(scene.analysis.steps, fewest_settling_steps);
  settling.until = RestCriterion{.kinetic = std::nullopt, .displacement = TrialLimits{}.rest_speed};
  for (Joint& joint : settling.joints) joint.glued = true;
  if (!scene.stages.empty()) own = scene.stages.front();
  scene.stages = {settling, own};
  return scene;
}

bool has_strength(const Joint& joint) {
  return joint.friction_angle > 0 || joint.cohesion > 0 || joint.tensile_strength > 0;
}

}  // namespace

bool is_ductile(const Joint& joint) {
  return (joint.cohesion > 0 || joint.tensile_strength > 0) && !joint.residual_friction_angle;
}

Joint reduced(Joint joint, double factor) {
  constexpr double degree = std::numbers::pi / 180;
  const auto reduce = [&](double& angle) { angle = std::atan(std::tan(angle * degree) / factor) / degree; };
  reduce(joint.friction_angle);
  if (joint.residual_friction_angle) reduce(*joint.residual_friction_angle);
  joint.cohesion /= factor;
  joint.tensile_strength /= factor;
  return joint;
}

StrengthReduction::StrengthReduction(const Scene& scene, std::vector<int> joints)
    : scene_(scene.stages.size() < 2 ? with_settling(scene) : scene), joints_(std::move(joints)) {
  const std::vector<Joint>& last = scene_.stages.back().joints;
  if (std::ranges::none_of(joints_, [&](int j) { return has_strength(last[j]); }))
    throw Error("no joint to be reduced has friction, cohesion or tensile strength in the last stage");
  for (StageDescription& stage : scene_.stages)
    for (Joint& joint : stage.joints) joint.ductile = is_ductile(joint);
  settle();
}

void StrengthReduction::settle() {
  BuiltScene built = build(scene_);
  notes_ = built.notes;
  Stepper& stepper = *built.stepper;
  const int before_last = static_cast<int>(scene_.stages.size()) - 2;
  const auto is_settled = [&] {
    const StageEnd end = stepper.stage_end();
    return end.stage == before_last &&
           (end.came_to_rest || end.steps >= scene_.stages[end.stage].analysis.steps);
  };
  while (!is_settled())
    if (!stepper.step()) throw SettlingStopped("the scene does not settle: " + stepper.stop_reason());
  const Equilibrium& e = stepper.equilibrium();
  if (!e.in_balance())
    unsettled_ = "block \"" + scene_.block_name(e.unbalanced_block) + "\" is out of balance";
  else if (e.relative_speed > TrialLimits{}.rest_speed && e.fastest_block >= 0)
    unsettled_ = "block \"" + scene_.block_name(e.fastest_block) + "\" moves";
  settled_ = stepper.run_record();
}

StrengthTrial StrengthReduction::try_factor(double factor, const TrialLimits& limits,
                                            const std::function<bool()>& given_up) const {
  Scene scene = scene_;
  for (const int j : joints_) {
    Joint& joint = scene.stages.back().joints[j];
    joint = reduced(joint, factor);
  }
  const BuiltScene built = build(scene);
  built.stepper->restore(*settled_);
  built.stepper->interrupt_when(given_up);
  StrengthTrial trial = run_trial(*built.stepper, limits);
  trial.factor = factor;
  return trial;
}

}  // namespace ddacontact
