#include <ddacontact/scene/geometry_writer.hpp>

#include <ddacontact/output/whole_file.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/scene/value_text.hpp>
#include <ddacontact/scene/writer.hpp>

#include <algorithm>
#include <limits>
#include <sstream>
#include <string_view>

namespace ddacontact {

namespace {

/// The vertices one after the other, each between `open` and `close`, and once more the first when `closed`;
/// without a minus before a zero.
std::string vertex_list(const Points& polygon, bool closed, std::string_view open, std::string_view between,
                        std::string_view close) {
  std::string text;
  const Index n = polygon.cols() + (closed ? 1 : 0);
  for (Index k = 0; k < n; ++k) {
    const auto vertex = polygon.col(k % polygon.cols());
    if (k > 0) text += ", ";
    text += open;
    text += scene_format::short_number(vertex.x() + 0.0);
    text += between;
    text += scene_format::short_number(vertex.y() + 0.0);
    text += close;
  }
  return text;
}

/// `properties` are of each polygon, without their braces; empty: of none.
void write_geojson(std::ostream& out, const std::vector<Points>& polygons,
                   const std::vector<std::string>& properties) {
  out << "{\"type\": \"FeatureCollection\", \"features\": [\n";
  for (std::size_t i = 0; i < polygons.size(); ++i)
    out << R"({"type": "Feature", "properties": {)" << (properties.empty() ? "" : properties[i])
        << R"(}, "geometry": {"type": "Polygon", "coordinates": [[)"
        << vertex_list(polygons[i], true, "[", ", ", "]") << "]]}}"
        << (i + 1 < polygons.size() ? ",\n" : "\n");
  out << "]}\n";
}

/// What a feature may say of a block, as members of a JSON object.
std::string properties_of(const BlockDescription& block, const Scene& scene, int n_unnamed_materials) {
  std::string text;
  const auto add = [&](const char* key, const std::string& value) {
    text += (text.empty() ? "\"" : ", \"") + std::string(key) + "\": " + value;
  };
  if (!block.name.empty()) add("name", scene_format::quoted(block.name));
  if (block.material >= n_unnamed_materials)
    add("material", scene_format::quoted(scene.materials[block.material].name));
  if (block.model != BlockModel::automatic) add("model", scene_format::value_text(block.model));
  if (!block.groups.empty()) add("group", scene_format::value_text(block.groups));
  if (block.fixed || !block.fixed_vertices.empty())
    add("fixed", scene_format::value_text(scene_format::FixedVertices{block.fixed, block.fixed_vertices}));
  return text;
}

void write_wkt(std::ostream& out, const std::vector<Points>& polygons) {
  for (const Points& polygon : polygons)
    out << "POLYGON ((" << vertex_list(polygon, true, "", " ", "") << "))\n";
}

/// As old programs read it too: R12, which has POLYLINE alone. `layers` are of each polygon; empty: layer 0.
void write_dxf(std::ostream& out, const std::vector<Points>& polygons,
               const std::vector<std::string>& layers) {
  const auto number = [](double value) { return scene_format::short_number(value + 0.0); };
  out << "0\nSECTION\n2\nENTITIES\n";
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::string layer = "8\n" + (layers.empty() || layers[i].empty() ? "0" : layers[i]) + '\n';
    out << "0\nPOLYLINE\n" << layer << "66\n1\n70\n1\n10\n0\n20\n0\n30\n0\n";
    for (const auto& vertex : polygons[i].colwise())
      out << "0\nVERTEX\n"
          << layer << "10\n"
          << number(vertex.x()) << "\n20\n"
          << number(vertex.y()) << "\n30\n0\n";
    out << "0\nSEQEND\n" << layer;
  }
  out << "0\nENDSEC\n0\nEOF\n";
}

constexpr const char* scene_head = R"(
[analysis]
steps     = 50
time_step = 0.01              # s
gravity   = [0.0, -9.8]       # m/s2

[[material]]
name    = "rock"
density = 2500.0              # kg/m3
young   = "5 GPa"
poisson = 0.25

[[joint]]
name = "rock joint"
friction_angle = 35.0         # degrees
)";

void write_scene(std::ostream& out, const std::vector<Points>& polygons, const std::string& title) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Points& polygon : polygons) {
    lowest = std::min(lowest, polygon.row(1).minCoeff());
    highest = std::max(highest, polygon.row(1).maxCoeff());
  }
  const double level = lowest + 1e-9 * (highest - lowest);
  out << "format = 1\ntitle = " << scene_format::quoted(title) << '\n' << scene_head;
  for (const Points& polygon : polygons) {
    out << "\n[[block]]\nmaterial = \"rock\"\n";
    if (polygon.row(1).minCoeff() <= level) out << "fixed = true\n";
    out << "vertices = [" << vertex_list(polygon, false, "[", ", ", "]") << "]\n";
  }
}

}  // namespace

GeometryFormat geometry_format(const std::string& path) {
  const std::string_view file(path);
  if (file.ends_with(".geojson")) return GeometryFormat::geojson;
  if (file.ends_with(".wkt")) return GeometryFormat::wkt;
  if (file.ends_with(".dxf")) return GeometryFormat::dxf;
  if (file.ends_with(".toml")) return GeometryFormat::toml;
  throw Error("\"" + path + "\" has an unknown ending (known: .geojson, .wkt, .dxf, .toml)");
}

std::optional<std::filesystem::path> write_geometry(const std::string& path,
                                                    const std::vector<Points>& polygons,
                                                    const std::string& title) {
  const GeometryFormat format = geometry_format(path);
  std::ostringstream out;
  if (format == GeometryFormat::geojson) write_geojson(out, polygons, {});
  if (format == GeometryFormat::wkt) write_wkt(out, polygons);
  if (format == GeometryFormat::dxf) write_dxf(out, polygons, {});
  if (format == GeometryFormat::toml) write_scene(out, polygons, title);
  return write_and_keep_older(path, out.view());
}

std::optional<std::filesystem::path> write_blocks(const std::string& path, const Scene& scene,
                                                  int n_unnamed_materials) {
  const GeometryFormat format = geometry_format(path);
  std::vector<Points> polygons;
  std::vector<std::string> properties, layers;
  for (const BlockDescription& block : scene.blocks) {
    polygons.push_back(block.vertices);
    properties.push_back(properties_of(block, scene, n_unnamed_materials));
    layers.push_back(block.groups.empty() ? "" : block.groups.front());
  }
  std::ostringstream out;
  if (format == GeometryFormat::geojson) write_geojson(out, polygons, properties);
  if (format == GeometryFormat::wkt) write_wkt(out, polygons);
  if (format == GeometryFormat::dxf) write_dxf(out, polygons, layers);
  if (format == GeometryFormat::toml) write_scene(out, scene);
  return write_and_keep_older(path, out.view());
}

}  // namespace ddacontact
