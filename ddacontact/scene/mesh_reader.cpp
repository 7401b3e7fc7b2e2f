#include <ddacontact/scene/mesh_reader.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/io/gmsh_reader.hpp>
#include <polyfem/io/vtu_mesh.hpp>

#include <charconv>
#include <memory>

namespace ddacontact::scene_format {

namespace {

/// The message of a reader, "PATH:LINE: WHAT: CURE" or "PATH: WHAT: CURE", as a problem of the file.
void add_problem(const std::string& message, const std::string& path, ProblemList& problems) {
  SourceLocation location{std::make_shared<const std::string>(path), 1, 1};
  std::string_view text = message;
  if (text.starts_with(path + ":")) text.remove_prefix(path.size() + 1);
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), location.line);
  if (status == std::errc()) text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  const std::size_t colon = text.rfind(": ");
  problems.error(location, std::string(text.substr(0, colon)),
                 colon == text.npos ? "write the mesh again" : std::string(text.substr(colon + 2)));
}

}  // namespace

bool is_mesh_file(const std::string& path) {
  const std::string ending = small_ending(path);
  return ending == ".msh" || ending == ".vtu";
}

GeometryBlocks read_mesh_blocks(const std::string& path, ProblemList& problems) {
  GeometryBlocks result;
  polyfem::NamedMesh named;
  try {
    named = small_ending(path) == ".msh" ? polyfem::read_gmsh(path) : polyfem::read_vtu_mesh(path);
  } catch (const polyfem::Error& error) {
    add_problem(error.what(), path, problems);
    return result;
  }
  const SourceLocation location{std::make_shared<const std::string>(path), 1, 1};
  for (int c = 0; c < named.mesh.n_cells(); ++c) {
    BlockRecord& block = result.blocks.emplace_back();
    block.origin = "cell " + std::to_string(c);
    block.locations.table = location;
    block.locations.add("vertices", location, true);
    block.vertices.points = named.mesh.outline(c);
  }
  for (const auto& [name, cells] : named.cell_groups)
    for (const int c : cells) result.blocks[c].groups.push_back(name);
  result.complete = true;
  return result;
}

}  // namespace ddacontact::scene_format
