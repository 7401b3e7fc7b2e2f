#include <ddacontact/scene/blocks_reader.hpp>

#include <ddacontact/scene/complete_document.hpp>
#include <ddacontact/scene/document_reader.hpp>
#include <ddacontact/scene/file_text.hpp>
#include <ddacontact/scene/geometry_file.hpp>
#include <ddacontact/scene/parameters.hpp>
#include <ddacontact/scene/preset_defaults.hpp>
#include <ddacontact/scene/resolve.hpp>
#include <ddacontact/scene/snap_blocks.hpp>
#include <ddacontact/scene/toml_file.hpp>

#include <algorithm>
#include <exception>

namespace ddacontact {

namespace {

using scene_format::BlockRecord;
using scene_format::Document;
using scene_format::MaterialRecord;
using scene_format::ProblemList;

MaterialRecord rock(const std::string& name) {
  MaterialRecord material;
  material.name = name;
  material.density = 2500.0;
  material.young = 5e9;
  material.poisson = 0.25;
  for (const char* key : {"name", "density"}) material.locations.add(key, {}, true);
  return material;
}

/// A feature may call its material by index too: that is a name like another here.
void name_materials(Document& document) {
  document.materials.push_back(rock("rock"));
  for (BlockRecord& block : document.blocks) {
    if (!block.locations.good("material")) continue;
    if (block.material.index) block.material = {std::to_string(*block.material.index), std::nullopt};
    const std::string& name = block.material.name;
    const auto known = std::find_if(document.materials.begin() + 1, document.materials.end(),
                                    [&](const MaterialRecord& material) { return material.name == name; });
    if (known == document.materials.end()) document.materials.push_back(rock(name));
    if (name == document.materials[0].name) document.materials[0].name += " without a name";
  }
}

Document geometry_document(const std::string& path, double snap, bool& unreadable, ProblemList& problems) {
  Document document;
  document.title = "Blocks of " + path;
  document.analysis.options.steps = 50;
  document.analysis.options.time_step = 0.01;
  document.joints.push_back({.name = "rock joint", .joint = {}, .between = std::nullopt, .locations = {}});
  document.joints[0].joint.friction_angle = 35;
  scene_format::GeometryBlocks file = scene_format::read_geometry_file(path, {}, problems);
  unreadable = file.unreadable;
  document.has_all_blocks = file.complete;
  document.blocks = std::move(file.blocks);
  name_materials(document);
  if (snap > 0) document.snap = snap;
  scene_format::snap_blocks(document, problems);
  return document;
}

std::optional<Document> scene_document(const std::string& path, double snap, bool& unreadable,
                                       ProblemList& problems) {
  const scene_format::FileText file = scene_format::read_text(path);
  unreadable = !file.text;
  if (!file.text) {
    problems.error({}, "'" + path + "' cannot be read: " + file.reason, "check the path and the permissions");
    return std::nullopt;
  }
  std::optional<toml::table> root = scene_format::parse_toml(*file.text, path, problems);
  if (!root) return std::nullopt;
  scene_format::put_parameters(*root, problems);
  Document document = scene_format::read_document(*root, problems);
  if (snap > 0) document.snap = snap;
  unreadable =
      !scene_format::complete_document(std::filesystem::path(path).parent_path(), document, problems);
  return document;
}

/// With every block checked as one of any shape.
Scene resolve_any_shape(Document& document, ProblemList& problems) {
  const BlockModel usual =
      document.analysis.block_model.value_or(defaults_of(document.analysis.options.preset).block_model);
  std::vector<BlockModel> models;
  for (BlockRecord& block : document.blocks) {
    models.push_back(block.model.value_or(usual));
    block.model = BlockModel::automatic;
  }
  Scene scene = scene_format::resolve(document, problems);
  for (std::size_t b = 0; b < models.size(); ++b) scene.blocks[b].model = models[b];
  return scene;
}

}  // namespace

BlocksReading read_blocks(const std::string& path, double snap) {
  BlocksReading reading;
  ProblemList problems(path);
  try {
    const bool is_scene = std::filesystem::path(path).extension() == ".toml";
    std::optional<Document> document =
        is_scene ? scene_document(path, snap, reading.scene.unreadable, problems)
                 : geometry_document(path, snap, reading.scene.unreadable, problems);
    reading.n_unnamed_materials = is_scene ? 0 : 1;
    if (document) {
      Scene scene = resolve_any_shape(*document, problems);
      if (!problems.has_errors()) reading.scene.scene = std::move(scene);
    }
  } catch (const std::exception& error) {
    problems.error({}, std::string("the file cannot be read: ") + error.what(), "make it smaller or simpler");
  }
  reading.scene.problems = std::move(problems).sorted();
  return reading;
}

}  // namespace ddacontact
