// What each feature adds to a step of a wall of 400 bricks in which it acts on few of them. Steps with and
// without the feature alternate; the quotient is that of their processor times, the median over the steps.
// Prints a table in Markdown.
//
//     feature_costs          measures
//     feature_costs --check  counts instead: a feature that acts on nothing changes no byte and no count
//                            of work
#include <tests/performance/scenes.hpp>
#include <tests/performance/steps/clock.hpp>

#include <fmt/format.h>
#include <ddacontact/scene/builder.hpp>
#include <polyfem/assembly/blas.hpp>

#include <array>
#include <exception>
#include <string_view>

using namespace performance;

namespace {

constexpr int n_bricks = 400, n_warm_steps = 10, n_steps = 40;

/// The brick whose centroid is nearest.
int brick_at(const Scene& scene, const Vec2& place) {
  const auto distance = [&](const BlockDescription& block) {
    return (block.vertices.rowwise().mean() - place).norm();
  };
  return static_cast<int>(std::ranges::min_element(scene.blocks, {}, distance) - scene.blocks.begin());
}

/// A joint of its own between four bricks in the middle and all others.
Joint& joint_of_four(Scene& scene) {
  scene.materials.push_back(scene.materials[0]);
  scene.materials.back().name = "other rock";
  for (const double x : {9., 10.})
    for (const double y : {5.25, 5.75})
      scene.blocks[static_cast<std::size_t>(brick_at(scene, {x, y}))].material = 1;
  Joint joint = scene.joints[0];
  joint.name = "of four";
  joint.between = {0, 1};
  return scene.joints.emplace_back(joint);
}

/// A joint that no two bricks have.
template <class Set>
void idle_joint(Scene& scene, const Set& set) {
  Joint joint = scene.joints[0];
  joint.name = "idle";
  set(joint);
  scene.joints.push_back(joint);
}

RockBolt bolt(RockBolt::Kind kind) {
  RockBolt bar{
      .name = "bolt", .from = {8.3, 7.3}, .to = {11.8, 7.6}, .kind = kind, .area = 5e-4, .young = 200e9};
  bar.pretension = 50e3;
  bar.yield_force = 250e3;
  bar.bond_stiffness = 1e8;
  bar.bond_strength = 2e5;
  return bar;
}

TimeFunction shaking(const Vec2& amplitude) {
  std::vector<Vec3> entries;
  for (int k = 0; k <= 400; ++k) {
    const double time = 0.005 * k, value = std::sin(2 * std::numbers::pi * time);
    entries.emplace_back(time, amplitude.x() * value, amplitude.y() * value);
  }
  return history_function(TimeFunction::Kind::smooth_history, entries);
}

struct Feature {
  const char* name;
  const char* acts_on;
  void (*add)(Scene& scene);
  /// The same where it acts on nothing.
  void (*add_idle)(Scene& scene);
};

constexpr std::array features{
    Feature{"stiffness of a joint", "4 bricks",
            [](Scene& s) {
              Joint& joint = joint_of_four(s);
              joint.normal_stiffness = 10e9;
              joint.shear_stiffness = 5e9;
            },
            [](Scene& s) {
              idle_joint(s, [](Joint& j) {
                j.normal_stiffness = 10e9;
                j.shear_stiffness = 5e9;
              });
            }},
    Feature{"residual friction, dilation", "4 bricks",
            [](Scene& s) {
              Joint& joint = joint_of_four(s);
              joint.residual_friction_angle = 30;
              joint.dilation_angle = 5;
            },
            [](Scene& s) {
              idle_joint(s, [](Joint& j) {
                j.residual_friction_angle = 30;
                j.dilation_angle = 5;
              });
            }},
    Feature{"strength in compression", "4 bricks",
            [](Scene& s) { joint_of_four(s).compressive_strength = 20e6; },
            [](Scene& s) { idle_joint(s, [](Joint& j) { j.compressive_strength = 20e6; }); }},
    Feature{"water", "3 rows",
            [](Scene& s) {
              s.water.table = Points(2, 1);
              s.water.table << 0, 1.4;
            },
            [](Scene& s) {
              s.water.table = Points(2, 1);
              s.water.table << 0, -50;
            }},
    Feature{"anchored bolt", "2 bricks", [](Scene& s) { s.bolts.push_back(bolt(RockBolt::Kind::anchored)); },
            nullptr},
    Feature{"grouted bolt", "4 bricks", [](Scene& s) { s.bolts.push_back(bolt(RockBolt::Kind::grouted)); },
            nullptr},
    Feature{"quake", "all bricks",
            [](Scene& s) {
              s.quakes.push_back({shaking({0.5, 0})});
            },
            [](Scene& s) {
              s.quakes.push_back({shaking({0, 0})});
            }},
    Feature{"history of a load", "1 brick",
            [](Scene& s) {
              s.loads.push_back({.name = "push",
                                 .block = brick_at(s, {9.5, 9.75}),
                                 .at = {9.5, 9.75},
                                 .force = shaking({2e3, 0})});
            },
            [](Scene& s) {
              s.loads.push_back({.name = "push",
                                 .block = brick_at(s, {9.5, 9.75}),
                                 .at = {9.5, 9.75},
                                 .force = shaking({0, 0})});
            }},
    Feature{"moving support", "1 brick",
            [](Scene& s) {
              s.supports.push_back({.block = brick_at(s, {9.5, 9.75}),
                                    .vertices = {2, 3},
                                    .displacement = shaking({1e-5, 0})});
            },
            nullptr},
    Feature{"quiet boundary", "4 faces",
            [](Scene& s) {
              QuietBoundary boundary;
              boundary.to = {0, 10};
              for (const double y : {4.25, 4.75, 5.25, 5.75}) {
                const int brick = brick_at(s, {0, y});
                boundary.faces.push_back({brick, 3});
              }
              s.quiet_boundaries.push_back(boundary);
            },
            nullptr}};

/// The wall, kept awake.
Scene wall(bool settled) {
  Scene scene = brick_wall(n_bricks);
  scene.analysis.skip.sleep = false;
  if (settled)
    settle_first(scene);
  else
    scene.stages = {scene.stage("measured")};
  return scene;
}
Scene wall_with(void (*add)(Scene&), bool settled) {
  Scene scene = wall(settled);
  add(scene);
  for (StageDescription& stage : scene.stages) {
    stage.joints = scene.joints;
    stage.water = scene.water;
  }
  if (!scene.bolts.empty()) scene.stages.front().bolts = {0};
  if (!scene.loads.empty()) scene.stages.front().loads = {0};
  return scene;
}

/// A wall that is stepped.
class Run {
 public:
  Run(const Scene& scene, const char* name) : built_(build(scene)), name_(name) {}
  /// Processor time, s.
  double step() {
    const double start = step_performance::processor_time();
    if (!built_.stepper->step())
      throw Error(fmt::format("{} stops: {}", name_, built_.stepper->stop_reason()));
    return step_performance::processor_time() - start;
  }
  const Stepper& stepper() const { return *built_.stepper; }
  double iterations() const { return static_cast<double>(stepper().counts().contact_iterations); }

 private:
  BuiltScene built_;
  const char* name_;
};

std::string measured(const Feature& feature, bool settled) {
  const Scene plain_scene = wall(settled), scene = wall_with(feature.add, settled);
  Run plain(plain_scene, "the wall"), with(scene, feature.name);
  const int n_before = n_warm_steps + (settled ? scene.stages.front().analysis.steps : 0);
  for (int k = 0; k < n_before; ++k) plain.step(), with.step();
  const double plain_before = plain.iterations(), with_before = with.iterations();
  std::vector<double> seconds, quotients;
  for (int k = 0; k < n_steps; ++k) {
    seconds.push_back(plain.step());
    quotients.push_back(with.step() / seconds.back());
  }
  using step_performance::median;
  return fmt::format("{:.1f} | {:.1f} | {:.1f} | {:.2f}", 1e3 * median(seconds),
                     (plain.iterations() - plain_before) / n_steps,
                     (with.iterations() - with_before) / n_steps, median(quotients));
}

void measure() {
  fmt::print(
      "| feature | acts on | settling: ms a step | iterations | with it | time | settled: ms a step | "
      "iterations | with it | time |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Feature& feature : features)
    fmt::print("| {} | {} | {} | {} |\n", feature.name, feature.acts_on, measured(feature, false),
               measured(feature, true));
}

/// What must not differ.
struct Outcome {
  Points position;
  std::array<long, 4> counts;
  bool operator==(const Outcome& other) const { return position == other.position && counts == other.counts; }
};
Outcome outcome(const Scene& scene, const char* name) {
  Run run(scene, name);
  for (int k = 0; k < n_warm_steps; ++k) run.step();
  const StepCounts& counts = run.stepper().counts();
  return {run.stepper().state().position,
          {counts.contact_iterations, counts.linear_solves, counts.factorizations, counts.contacts}};
}

bool check() {
  const Outcome plain = outcome(wall(false), "the wall");
  bool good = true;
  for (const Feature& feature : features) {
    if (!feature.add_idle || outcome(wall_with(feature.add_idle, false), feature.name) == plain) continue;
    fmt::print("{}: acts on nothing, and the steps differ\n", feature.name);
    good = false;
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    polyfem::pin_blas_to_one_thread();
    if (argc == 2 && std::string_view(argv[1]) == "--check") return check() ? 0 : 1;
    measure();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "feature_costs: error: {}\n", error.what());
    return 1;
  }
}
