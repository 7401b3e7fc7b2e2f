#include <ddacontact/study/strength_reduction.hpp>

#include <ddacontact/output/run_verdict.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ddacontact {

namespace {

constexpr int fewest_settling_steps = 1000;
/// Static steps that let go what strengths no longer hold, in which waves cross each block so often: inertia
/// then hinders no block from following another that slips and from pressing on it.
constexpr int release_steps = 100, crossings_a_step = 5;

double release_time_step(const Scene& scene) {
  double longest = 0;
  for (const BlockDescription& block : scene.blocks) {
    if (block.fixed) continue;
    const Material& material = scene.materials[block.material];
    const double size = std::sqrt(std::abs(polyfem::signed_area(block.vertices)));
    longest = std::max(longest, size / std::sqrt(material.young / material.density));
  }
  return crossings_a_step * longest;
}

bool has_strength(const Joint& joint) {
  return joint.friction_angle > 0 || joint.cohesion > 0 || joint.tensile_strength > 0;
}

/// Static steps until all rests.
StageDescription settling(StageDescription stage, std::string name, int steps) {
  stage.name = std::move(name);
  stage.analysis.mode = Mode::statics;
  stage.analysis.steps = steps;
  stage.until = RestCriterion{.kinetic = std::nullopt, .displacement = TrialLimits{}.rest_speed};
  return stage;
}

/// In two parts: settled while the joints to be reduced are glued, then as it is. Others bear from the
/// beginning what they bear in the trials: glued, they would carry what is to press on the former.
Scene with_settling(Scene scene, const std::vector<int>& joints) {
  if (scene.contact.method == ContactMethod::classic)
    throw Error("a scene of one part settles glued, which the method \"classic\" cannot (write [[stage]]s)");
  StageDescription glued =
      settling(scene.stage(""), "settle", std::max(scene.analysis.steps, fewest_settling_steps));
  for (const int j : joints) glued.joints[j].glued = has_strength(glued.joints[j]);
  scene.stages = {glued, scene.stages.empty() ? scene.stage("") : scene.stages.front()};
  return scene;
}

/// Whether the last stage changes nothing but strengths at its start: what an excavation shakes loose is its
/// own.
bool begins_by_strengths(const Scene& scene) {
  const StageDescription& last = scene.stages.back();
  return last.removed.empty() && last.bolts.empty() && last.added.empty() && last.loads.empty();
}

/// A factor of what cannot move would be without limit, and count as safe in a sweep.
void refuse_held(const Scene& scene, const BlockSystem& blocks) {
  const auto is_free = [&](int b) { return !scene.blocks[b].fixed; };
  bool may_move = std::ranges::any_of(
      scene.stages, [&](const auto& stage) { return std::ranges::any_of(stage.added, is_free); });
  for (int b = 0; b < blocks.n_blocks(); ++b) may_move = may_move || !blocks.is_unchanging(b);
  if (!may_move)
    throw Error(
        "no block can move: all are held (let some go; lines that are to divide a domain must meet, as "
        "'snap' makes them)");
}

/// What is pulled by a hundredth of its weight slides at the speed at which damping balances that.
std::optional<std::string> note_on_damping(const Scene& scene, const BlockSystem& blocks) {
  const AnalysisOptions& last = scene.stages.back().analysis;
  double largest = 0;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    if (blocks.is_movable(b)) largest = std::max(largest, blocks.block(b).size());
  const double weight = last.gravity.norm(), speed = TrialLimits{}.rest_speed * largest;
  if (last.mode == Mode::statics || weight == 0 || last.damping.mass * speed <= weight / 100)
    return std::nullopt;
  return "damping by mass lets blocks slide as slowly as blocks at rest: factors are too large (no "
         "'damping')";
}

/// The last stage begins with long static steps, or consists of them.
void begin_by_release(Scene& scene) {
  StageDescription& last = scene.stages.back();
  const double time_step = std::max(last.analysis.time_step, release_time_step(scene));
  if (last.analysis.mode == Mode::statics) {
    last.analysis.time_step = time_step;
    return;
  }
  StageDescription release = last;
  release.name = "release";
  release.analysis.mode = Mode::statics;
  release.analysis.time_step = time_step;
  release.analysis.steps = release_steps;
  release.until.reset();
  release.reset_displacements = false;
  scene.stages.insert(std::prev(scene.stages.end()), std::move(release));
}

/// Static steps know no time: what acts when they have come to rest is what counts.
void refuse_passing_loads(const Scene& scene) {
  if (scene.stages.back().analysis.mode != Mode::statics) return;
  if (!scene.quakes.empty())
    throw Error(
        "the last stage is static, where shaking is over before blocks have moved by it (give the last "
        "stage the acceleration by 'gravity', or dynamic steps)");
  for (const Load& load : scene.loads) {
    if (!load.force.is_history()) continue;
    const double last = load.force.history.back().tail<2>().norm();
    for (const Vec3& entry : load.force.history)
      if (entry.tail<2>().norm() > last)
        throw Error(
            "the last stage is static, where a load " + (load.name.empty() ? "" : "'" + load.name + "' ") +
            "that decreases is over before blocks have moved by it (end its 'history' with its largest "
            "value, or take dynamic steps)");
  }
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
    : scene_(scene.stages.size() < 2 ? with_settling(scene, joints) : scene),
      n_settling_(static_cast<int>(scene_.stages.size()) - 1),
      joints_(std::move(joints)) {
  const std::vector<Joint>& last = scene_.stages.back().joints;
  if (std::ranges::none_of(joints_, [&](int j) { return has_strength(last[j]); }))
    throw Error("no joint to be reduced has friction, cohesion or tensile strength in the last stage");
  refuse_passing_loads(scene_);
  for (StageDescription& stage : scene_.stages)
    for (Joint& joint : stage.joints) joint.ductile = is_ductile(joint);
  settle(scene.stages.size() < 2);
}

void StrengthReduction::settle(bool glues) {
  BuiltScene built = build(scene_);
  notes_ = built.notes;
  Stepper& stepper = *built.stepper;
  refuse_held(scene_, stepper.blocks());
  if (auto note = note_on_damping(scene_, stepper.blocks())) notes_.push_back(std::move(*note));
  const double changed = last_change(stepper.blocks());
  const auto is_settled = [&] {
    const StageEnd end = stepper.stage_end();
    return end.stage == n_settling_ - 1 &&
           (end.came_to_rest || end.steps >= scene_.stages[end.stage].analysis.steps);
  };
  while (!is_settled()) {
    if (stepper.step()) continue;
    if (!glues || !begins_by_strengths(scene_) || changed > 0)
      throw SettlingStopped("the scene does not settle: " + stepper.stop_reason());
    notes_.push_back("the scene does not settle glued (" + stepper.stop_reason() +
                     "): trials settle it as it is");
    begin_by_release(scene_);
    scene_.stages.erase(scene_.stages.begin());
    n_settling_ = 0;
    return;
  }
  if (begins_by_strengths(scene_) && changed <= stepper.state().time) begin_by_release(scene_);
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
  for (auto stage = scene.stages.begin() + n_settling_; stage != scene.stages.end(); ++stage)
    for (const int j : joints_) stage->joints[j] = reduced(stage->joints[j], factor);
  const auto trial_of_scene = [&] {
    const BuiltScene built = build(scene);
    if (settled_) built.stepper->restore(*settled_);
    return run_trial(*built.stepper, limits, given_up);
  };
  StrengthTrial trial = trial_of_scene();
  const bool releases = settled_ && n_settling_ + 1 < static_cast<int>(scene.stages.size());
  if (trial.verdict == Verdict::stopped && releases && !(given_up && given_up())) {
    scene.stages.erase(scene.stages.begin() + n_settling_);
    const std::string why = trial.reason;
    trial = trial_of_scene();
    trial.reason += " (let go by dynamic steps, for after static ones it stopped: " + why + ")";
  }
  trial.factor = factor;
  return trial;
}

}  // namespace ddacontact
