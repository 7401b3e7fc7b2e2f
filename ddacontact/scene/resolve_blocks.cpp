#include <ddacontact/scene/mesh_check.hpp>
#include <ddacontact/scene/resolve_blocks.hpp>
#include <ddacontact/scene/text.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace ddacontact::scene_format {

bool Holds::holds_all(std::size_t block) const {
  return std::all_of(prescribed_by_[block].begin(), prescribed_by_[block].end(),
                     [](const auto& by) { return by[0] != nobody && by[1] != nobody; });
}

bool Holds::holds_any(std::size_t block) const {
  return std::any_of(prescribed_by_[block].begin(), prescribed_by_[block].end(),
                     [](const auto& by) { return by[0] != nobody || by[1] != nobody; });
}

bool Holds::holds_vertex(int block, int vertex) const {
  const std::array<int, 2>& by = prescribed_by_[block][vertex];
  return by[0] != nobody || by[1] != nobody;
}

std::vector<int> check_vertex_indices(const std::vector<int>& indices, int n_vertices,
                                      const std::string& title, const SourceLocation& location,
                                      ProblemList& problems) {
  std::vector<int> good;
  std::vector<bool> seen(n_vertices, false);
  for (const int k : indices) {
    if (k >= n_vertices) {
      problems.error(
          location, title + " has no vertex '" + std::to_string(k) + "'",
          n_vertices > 0 ? "vertices run from 0 to " + std::to_string(n_vertices - 1) : "it has no vertices");
    } else if (seen[k]) {
      problems.error(location, "vertex '" + std::to_string(k) + "' stands twice", "write each vertex once");
    } else {
      seen[k] = true;
      good.push_back(k);
    }
  }
  return good;
}

namespace {

/// One warning for all [[block]] that run clockwise; in geometry files both orientations are usual.
void warn_of_clockwise_blocks(const Document& document, const BlockTable& table, ProblemList& problems) {
  int first = -1, n_more = -1;
  for (int b = 0; b < table.names.size(); ++b) {
    if (!table.outlines[b].outline.turned || !document.blocks[b].origin.empty()) continue;
    if (++n_more == 0) first = b;
  }
  if (first < 0) return;
  const std::string title = table.names.title(first);
  problems.warning(
      table.outlines[first].location,
      n_more == 0 ? title + " runs clockwise: it is turned around"
                  : title + " and " + std::to_string(n_more) + " more run clockwise: they are turned around",
      "vertices keep their numbers");
}

/// The cells of a mesh each turn with a frame of their own.
void check_kinematics(const BlockRecord& block, const AnalysisRecord& analysis, Kinematics kinematics,
                      const std::string& title, ProblemList& problems) {
  if (kinematics == Kinematics::corotational || !analysis.locations.usable("kinematics")) return;
  const bool own = block.locations.written("model");
  problems.error(own ? block.locations.of("model") : analysis.locations.of("block_model"),
                 "the model \"mesh\" of " + title + " needs kinematics = \"corotational\"",
                 "write that, or model = \"mean_value\"");
}

/// -1 for edges without a joint of their own.
std::vector<int> resolve_edge_joints(const BlockRecord& block, const NameTable& joints,
                                     const std::string& title, ProblemList& problems) {
  std::vector<int> numbers;
  const SourceLocation& location = block.locations.of("edge_joints");
  for (const Reference& joint : block.edge_joints->joints)
    numbers.push_back(joint.name.empty() && !joint.index ? -1 : joints.find(joint, location, problems));
  const auto n_edges = static_cast<std::size_t>(block.vertices.points.cols());
  if (block.locations.good("vertices") && numbers.size() != n_edges)
    problems.error(location,
                   "'edge_joints' of " + title + " names " + std::to_string(numbers.size()) + " joints for " +
                       std::to_string(n_edges) + " edges",
                   "write one for each edge, \"\" where the materials decide");
  return numbers;
}

/// Blocks so small beside the scene that places on them are lost in round-off.
void check_sizes(BlockTable& table, ProblemList& problems) {
  constexpr double least_size = 1e-12;  // of the scene
  Eigen::AlignedBox2d scene;
  for (const PositionedOutline& block : table.outlines)
    for (const auto& vertex : block.outline.polygon.colwise()) scene.extend(Vec2(vertex));
  if (scene.isEmpty()) return;
  const double extent = scene.diagonal().norm();
  for (int b = 0; b < table.names.size(); ++b) {
    CheckedOutline& outline = table.outlines[b].outline;
    if (!outline.valid() || outline.size >= least_size * extent) continue;
    problems.error(table.outlines[b].location,
                   table.names.title(b) + " of " + rounded(outline.size) +
                       " m is lost in the round-off of a scene of " + rounded(extent) + " m",
                   "are all coordinates in m? Leave out what is so large, or draw a part of it");
    outline.polygon.resize(2, 0);
  }
}

}  // namespace

BlockTable resolve_blocks(const Document& document, const AnalysisOptions& analysis,
                          const NameTable& materials, const NameTable& joints, ProblemList& problems) {
  BlockTable table;
  table.descriptions.reserve(document.blocks.size());
  table.outlines.reserve(document.blocks.size());
  for (const BlockRecord& record : document.blocks) {
    const int index = table.names.size();
    const KeyLocations& locations = record.locations;
    table.names.add(record.name, locations, problems, record.origin);
    const std::string title = table.names.title(index);

    BlockDescription& block = table.descriptions.emplace_back();
    block.name = record.name.value_or("");
    if (locations.good("material"))
      block.material = materials.find(record.material, locations.of("material"), problems, record.origin);
    block.vertices = record.vertices.points;
    if (record.edge_joints && locations.usable("edge_joints"))
      block.edge_joints = resolve_edge_joints(record, joints, title, problems);
    block.groups = record.groups;
    block.model = record.model.value_or(analysis.block_model);
    block.mesh = record.mesh ? with_record(analysis.mesh, *record.mesh) : analysis.mesh;
    block.velocity = record.velocity;
    block.angular_velocity = record.angular_velocity;
    block.stress = record.stress;
    block.stress_gradient = record.stress_gradient;

    PositionedOutline& placed = table.outlines.emplace_back();
    placed.location = locations.of("vertices");
    const bool model_is_known = locations.written("model")
                                    ? locations.good("model")
                                    : document.analysis.locations.usable("block_model");
    if (locations.good("vertices"))
      placed.outline = check_outline(record.vertices, model_is_known ? block.model : BlockModel::automatic,
                                     locations, title, problems);
    if (model_is_known && block.model == BlockModel::mesh) {
      check_kinematics(record, document.analysis, analysis.kinematics, title, problems);
      if (placed.outline.valid())
        check_mesh(placed.outline, block.mesh, record, document.analysis.mesh, title, problems);
    }

    const int n = static_cast<int>(block.vertices.cols());
    table.holds.add_block(n);
    block.fixed = record.fixed.all;
    if (locations.good("fixed") && locations.good("vertices"))
      block.fixed_vertices =
          check_vertex_indices(record.fixed.some, n, title, locations.of("fixed"), problems);
    for (const int k : block.fixed_vertices)
      for (const int axis : {0, 1}) table.holds.by(index, k, axis) = Holds::fixed;
    for (int k = 0; block.fixed && k < n; ++k)
      for (const int axis : {0, 1}) table.holds.by(index, k, axis) = Holds::fixed;
  }
  check_sizes(table, problems);
  if (!document.has_all_blocks) table.names.set_incomplete();
  table.names.warn_of_ambiguous_names(problems);
  warn_of_clockwise_blocks(document, table, problems);
  return table;
}

}  // namespace ddacontact::scene_format
