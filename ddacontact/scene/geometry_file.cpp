#include <ddacontact/scene/geometry_file.hpp>

#include <ddacontact/scene/drawing_file.hpp>
#include <ddacontact/scene/file_text.hpp>
#include <ddacontact/scene/geojson_reader.hpp>
#include <ddacontact/scene/mesh_reader.hpp>
#include <ddacontact/scene/wkt_reader.hpp>

#include <algorithm>
#include <iterator>
#include <memory>

namespace ddacontact::scene_format {

std::string small_ending(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

GeometryBlocks read_geometry_file(const std::string& path, const SourceLocation& key, ProblemList& problems,
                                  const std::string& key_name) {
  const std::string ending = small_ending(path);
  const bool is_json = ending == ".geojson" || ending == ".json";
  if (!is_json && ending != ".wkt" && !is_drawing(path) && !is_mesh_file(path)) {
    problems.error(
        key, "'" + key_name + "' = '" + path + "' is no geometry file by its ending '" + ending + "'",
        ending == ".ana" ? "Shi's analysis file is not read: write its numbers as keys of the scene, "
                           "their order is in doc/scene_format.md, [domain]"
                         : "known: .geojson, .json, .wkt, .dxf, .geo, .msh, .vtu");
    return {};
  }
  const FileText file = read_text(path);
  if (!file.text) {
    problems.error(key, "'" + key_name + "' = '" + path + "' cannot be read: " + file.reason,
                   "the path is relative to the scene's");
    return {.blocks = {}, .unreadable = true};
  }
  const auto source = std::make_shared<const std::string>(path);
  GeometryBlocks read = is_json              ? read_geojson(*file.text, source, problems)
                        : is_mesh_file(path) ? read_mesh_blocks(path, problems)
                        : is_drawing(path)
                            ? blocks_of(read_drawing(path, *file.text, problems), path, problems)
                            : read_wkt(*file.text, source, problems);
  if (read.complete && read.blocks.empty()) {
    problems.error({source, 1, 1}, "the file holds no polygon",
                   "give it one, or leave out '" + key_name + "'");
    read.complete = false;
  }
  return read;
}

bool add_geometry(const std::filesystem::path& directory, Document& document, ProblemList& problems) {
  if (!document.locations.written("blocks")) return true;
  document.has_all_blocks = false;
  if (!document.locations.good("blocks")) return true;
  GeometryBlocks file = read_geometry_file((directory / *document.geometry_file).string(),
                                           document.locations.of("blocks"), problems);
  document.has_all_blocks = file.complete;
  if (document.blocks.empty())
    document.blocks = std::move(file.blocks);
  else
    std::move(file.blocks.begin(), file.blocks.end(), std::back_inserter(document.blocks));
  return !file.unreadable;
}

}  // namespace ddacontact::scene_format
