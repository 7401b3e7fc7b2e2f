#include <ddacontact/scene/mesh_check.hpp>
#include <ddacontact/scene/text.hpp>

#include <polyfem/geometry/validity.hpp>

namespace ddacontact::scene_format {

namespace {

/// Of the block's size: what cells at contacts may be.
constexpr double smallest_at_contact = 1e-4;

/// Of a key that the block's mesh, or else that of the analysis, states.
const SourceLocation& location_of_key(const char* key, const BlockRecord& block, const MeshRecord& of_all) {
  if (block.mesh && block.mesh->locations.written(key)) return block.mesh->locations.of(key);
  return of_all.locations.written(key) ? of_all.locations.of(key) : block.locations.of("vertices");
}

}  // namespace

MeshOptions with_record(MeshOptions options, const MeshRecord& record) {
  if (record.locations.usable("kind")) options.kind = record.kind.value_or(options.kind);
  if (record.cells && record.locations.usable("cells")) {
    options.cells = *record.cells;
    options.cell_size = 0;
  }
  if (record.cell_size && record.locations.usable("cell_size")) options.cell_size = *record.cell_size;
  options.edge_nodes = record.edge_nodes.value_or(options.edge_nodes);
  if (record.locations.usable("at_contact"))
    options.at_contact = record.at_contact.value_or(options.at_contact);
  return options;
}

void check_mesh(const CheckedOutline& outline, const MeshOptions& options, const BlockRecord& block,
                const MeshRecord& of_all, const std::string& title, ProblemList& problems) {
  const double per_side = options.cell_size > 0 ? outline.size / options.cell_size : 0;
  if (per_side * per_side > most_cells)
    problems.error(location_of_key("cell_size", block, of_all),
                   "cells of " + rounded(options.cell_size) + " m in " + title + ", which is " +
                       rounded(outline.size) + " m large, are " + rounded(per_side * per_side) +
                       ", more than can be resolved",
                   "at most 1e6 are possible: write at least " + rounded(1.001e-3 * outline.size) + " m");
  const double finest = smallest_at_contact * outline.size;
  if (options.at_contact > 0 && options.at_contact < finest)
    problems.error(
        location_of_key("at_contact", block, of_all),
        "cells of " + rounded(options.at_contact) + " m where " + title + " touches others are too many",
        "write at least " + rounded(1.001 * finest) + " m");
  if (options.kind != CellKind::quads) return;
  const SourceLocation& location = location_of_key("kind", block, of_all);
  if (const auto n = outline.polygon.cols(); n != 4)
    problems.error(location,
                   "quads do not fit into " + title + ", which has " + std::to_string(n) + " vertices",
                   "quads fill convex blocks of four corners: write kind = \"voronoi\"");
  else if (polyfem::find_non_convex_corner(outline.polygon, straight_turn))
    problems.error(location, "quads do not fit into " + title + ", whose four corners are not convex",
                   "write kind = \"voronoi\"");
}

}  // namespace ddacontact::scene_format
