#include <ddacontact/scene/resumption.hpp>

#include <ddacontact/scene/builder.hpp>
#include <ddacontact/scene/reader.hpp>
#include <ddacontact/scene/writer.hpp>

#include <toml++/toml.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <variant>

namespace ddacontact {

namespace {

constexpr const char* cure = "resume with the scene it was made from, or run this one from its start";
constexpr const char* cure_as_stage =
    "change loads, water, quakes, strengths of joints or the schedule alone, or run this scene from its "
    "start";

using Path = std::vector<std::variant<std::string, std::size_t>>;

bool stands_on(const toml::node& node, toml::source_index line) {
  return node.source().begin.line <= line && line <= node.source().end.line;
}

/// The path of the value that stands on a line; empty: there is none.
Path path_to_line(const toml::node& node, toml::source_index line) {
  const auto find_in = [line](const auto& children, auto name_of) {
    for (auto&& [name, child] : children) {
      const bool has_parts = child.is_table() || child.is_array_of_tables();
      Path path = path_to_line(child, line);
      if (!path.empty() || (!has_parts && stands_on(child, line))) {
        path.insert(path.begin(), name_of(name));
        return path;
      }
    }
    return Path();
  };
  if (const toml::table* table = node.as_table())
    return find_in(*table, [](const toml::key& key) { return std::string(key.str()); });
  if (const toml::array* array = node.as_array(); array && array->is_array_of_tables()) {
    std::vector<std::pair<std::size_t, const toml::node&>> elements;
    for (std::size_t k = 0; k < array->size(); ++k) elements.emplace_back(k, (*array)[k]);
    return find_in(elements, [](std::size_t index) { return index; });
  }
  return {};
}

const toml::node* child_of(const toml::node& node, const Path::value_type& name) {
  if (const auto* key = std::get_if<std::string>(&name))
    return node.is_table() ? node.as_table()->get(*key) : nullptr;
  return node.is_array() ? node.as_array()->get(std::get<std::size_t>(name)) : nullptr;
}

/// Where a path, or as much of it as is there, stands in a file.
toml::source_position find_in_file(const std::string& file, const Path& path) {
  toml::source_position location{1, 1};
  const toml::table table = toml::parse_file(file);
  const toml::node* node = &table;
  for (const auto& name : path) {
    node = child_of(*node, name);
    if (!node) break;
    if (node->source().begin) location = node->source().begin;
  }
  return location;
}

Problem mismatch_at(const std::string& scene_file, toml::source_position location, const std::string& what,
                    const std::string& with_cure = cure) {
  return {Problem::Severity::error,          scene_file, static_cast<int>(location.line),
          static_cast<int>(location.column), what,       with_cure};
}

/// Of two texts, the first line of each that differs, and its number.
struct Difference {
  std::string one, other;
  int line;
};
Difference first_difference(const std::string& one, const std::string& other) {
  std::istringstream a(one), b(other);
  Difference difference{"", "", 0};
  do {
    difference.one.clear();
    difference.other.clear();
    std::getline(a, difference.one);
    std::getline(b, difference.other);
    ++difference.line;
  } while (difference.one == difference.other && (a || b));
  return difference;
}

/// Where the texts of two scenes differ; nothing: they do not.
std::optional<Problem> find_difference(const std::string& here, const std::string& in_checkpoint,
                                       const std::string& checkpoint_name, const std::string& scene_file,
                                       const char* with_cure) {
  if (here == in_checkpoint) return std::nullopt;
  const auto [one, other, line] = first_difference(here, in_checkpoint);
  const Path path = path_to_line(toml::parse(here), static_cast<toml::source_index>(line));
  const auto text = [](const std::string& words) { return words.empty() ? "nothing" : "'" + words + "'"; };
  return mismatch_at(scene_file, find_in_file(scene_file, path),
                     "\"" + checkpoint_name + "\" belongs to another scene: it has " + text(other) +
                         " where this one has " + text(one),
                     with_cure);
}

std::string text_of(const Scene& scene) {
  std::ostringstream text;
  write_scene(text, scene);
  return text.str();
}

/// What the stages of a scene cannot change.
Scene lasting_part(const Scene& scene) {
  const AnalysisOptions any;
  Scene part = scene;
  part.title.clear();
  part.output = {};
  part.loads.clear();
  part.water = {};
  part.quakes.clear();
  part.stages.clear();
  AnalysisOptions& a = part.analysis;
  a.mode = any.mode;
  a.steps = 1;
  a.time_step = 1;
  a.max_displacement_ratio = any.max_displacement_ratio;
  a.gravity = any.gravity;
  a.scheme = a.kinematics == Kinematics::corotational ? Scheme::decaying : Scheme::dda;
  a.beta = any.beta;
  a.gamma = any.gamma;
  a.damping = any.damping;
  a.cutting_factor = any.cutting_factor;
  a.skip = any.skip;
  for (Joint& joint : part.joints) {
    const Joint none;
    joint.friction_angle = none.friction_angle;
    joint.cohesion = none.cohesion;
    joint.tensile_strength = none.tensile_strength;
    joint.restitution = none.restitution;
    joint.dashpot = none.dashpot;
    joint.residual_friction_angle = none.residual_friction_angle;
  }
  return part;
}

/// The scene with the models that "auto" has chosen before, which the scene of a stage's checkpoint names.
Scene with_models_of(const Scene& before, const Scene& scene) {
  Scene part = scene;
  if (scene.blocks.size() != before.blocks.size()) return part;
  for (std::size_t b = 0; b < part.blocks.size(); ++b) {
    if (part.blocks[b].model != BlockModel::automatic) continue;
    part.blocks[b].model = before.blocks[b].model;
    part.blocks[b].mesh = before.blocks[b].mesh;
  }
  return part;
}

/// The stages that a run has made, the last one up to its checkpoint.
std::vector<StageDescription> stages_made(const Checkpoint& checkpoint, const Scene& before) {
  const StageProgress& progress = checkpoint.record.step.progress;
  std::vector<StageDescription> made = before.stages;
  if (made.empty()) made.push_back(before.stage(""));
  made.resize(static_cast<std::size_t>(progress.stage) + 1);
  for (std::size_t k = 0; k < checkpoint.stage_steps.size(); ++k)
    made[k].analysis.steps = checkpoint.stage_steps[k];
  if (made.back().analysis.steps != progress.steps && !progress.came_to_rest)
    made.back().reset_displacements = false;  // it did not come to its end
  made.back().analysis.steps = progress.steps;
  if (auto& relax = made.back().relax) relax = std::min(*relax, made.back().analysis.steps);
  return made;
}

/// Blocks and bolts that come in after the stage of a checkpoint.
struct Coming {
  std::set<int> blocks, bolts;

  Coming(const Scene& before, std::size_t n_made) {
    for (std::size_t k = n_made; k < before.stages.size(); ++k) {
      blocks.insert(before.stages[k].added.begin(), before.stages[k].added.end());
      bolts.insert(before.stages[k].bolts.begin(), before.stages[k].bolts.end());
    }
  }
};

/// What the stages of a scene remove or add that the checkpoint has no more, or already.
/// \param[in,out] coming  its bolts less those that a stage adds
std::optional<Problem> find_done_already(const Scene& scene, const std::string& scene_file,
                                         const std::string& checkpoint_name,
                                         const std::vector<StageDescription>& made, Coming& coming) {
  const auto done = [&](std::size_t k, const char* key, const std::string& what, const char* where) {
    return mismatch_at(scene_file, find_in_file(scene_file, {"stage", k, key}),
                       what + "' is " + where + " in \"" + checkpoint_name + "\"",
                       "leave it out of '" + std::string(key) + "'");
  };
  for (std::size_t k = 0; k < scene.stages.size(); ++k) {
    const StageDescription& stage = scene.stages[k];
    for (int block : stage.removed)
      if (std::ranges::any_of(made, [&](const auto& of) { return std::ranges::count(of.removed, block); }))
        return done(k, "remove", "block '" + scene.block_name(block), "gone");
    for (int bolt : stage.bolts)
      if (!coming.bolts.erase(bolt)) return done(k, "add", "bolt '" + scene.bolts[bolt].name, "there");
    for (int block : stage.added)
      if (!coming.blocks.contains(block)) return done(k, "add", "block '" + scene.block_name(block), "there");
  }
  return std::nullopt;
}

}  // namespace

std::string resumable_part(const Scene& scene) {
  Scene part = scene;
  part.output = {};
  part.analysis.steps = 1;
  for (StageDescription& stage : part.stages) stage.analysis.steps = std::max(1, stage.relax.value_or(1));
  return text_of(part);
}

std::vector<int> steps_of_stages_to(const Scene& scene, int stage) {
  std::vector<int> steps;
  const int n_stages = static_cast<int>(scene.stages.size());
  for (int k = 0; k <= stage && k < n_stages; ++k)
    steps.push_back(scene.stages[static_cast<std::size_t>(k)].analysis.steps);
  return steps;
}

std::optional<Problem> find_mismatch(const Checkpoint& checkpoint, const std::string& checkpoint_name,
                                     const Scene& scene, const std::string& scene_file) {
  if (auto difference =
          find_difference(resumable_part(scene), checkpoint.scene, checkpoint_name, scene_file, cure))
    return difference;
  const std::string quoted = "\"" + checkpoint_name + "\"";
  const StageProgress& progress = checkpoint.record.step.progress;
  for (std::size_t k = 0; k < checkpoint.stage_steps.size(); ++k) {
    const StageDescription& stage = scene.stages[k];
    const long steps = stage.analysis.steps, had = checkpoint.stage_steps[k];
    const bool present = static_cast<int>(k) == progress.stage, last = k + 1 == scene.stages.size();
    const bool over = !present || progress.steps == had || progress.came_to_rest;
    const bool fits =
        present && !(over && stage.reset_displacements) ? steps >= progress.steps || last : steps == had;
    if (fits) continue;
    return mismatch_at(scene_file, find_in_file(scene_file, {"stage", k, "steps"}),
                       quoted + " has made " + std::to_string(present ? progress.steps : had) +
                           " steps of stage " + std::to_string(k) + (over ? ", which is over" : "") +
                           ", not '" + std::to_string(steps) + "'");
  }
  return std::nullopt;
}

std::variant<Scene, Problem> scene_as_stage(const Checkpoint& checkpoint, const std::string& checkpoint_name,
                                            const Scene& scene, const std::string& scene_file) {
  const SceneReading reading = read_scene_text(checkpoint.scene, checkpoint_name);
  if (!reading.scene)  // written by a version with other keys
    return mismatch_at(scene_file, {1, 1},
                       "the scene in the checkpoint cannot be read: " + reading.problems[0].text(),
                       cure_as_stage);
  const Scene& before = *reading.scene;
  if (auto difference =
          find_difference(text_of(lasting_part(with_models_of(before, scene))), text_of(lasting_part(before)),
                          checkpoint_name, scene_file, cure_as_stage))
    return *difference;
  if (checkpoint.record.step.progress.steps == 0)
    return mismatch_at(scene_file, {1, 1}, "\"" + checkpoint_name + "\" has made no step of its stage",
                       cure_as_stage);
  Scene going_on = scene;
  const Scene with_models = with_chosen_models(before);  // which "auto" chose for the first run
  for (std::size_t b = 0; b < going_on.blocks.size(); ++b) {
    going_on.blocks[b].model = with_models.blocks[b].model;
    going_on.blocks[b].mesh = with_models.blocks[b].mesh;
  }
  std::vector<StageDescription>& stages = going_on.stages;
  if (stages.empty()) stages.push_back(scene.stage(""));
  const std::vector<StageDescription> made = stages_made(checkpoint, before);
  Coming coming(before, made.size());
  if (auto problem = find_done_already(going_on, scene_file, checkpoint_name, made, coming)) return *problem;
  // As loads and blocks, bolts that no stage adds are there from its start.
  stages.front().bolts.insert(stages.front().bolts.end(), coming.bolts.begin(), coming.bolts.end());
  stages.insert(stages.begin(), made.begin(), made.end());
  return going_on;
}

}  // namespace ddacontact
