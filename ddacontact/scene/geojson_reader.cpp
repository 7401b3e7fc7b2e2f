#include <ddacontact/scene/feature_properties.hpp>
#include <ddacontact/scene/geojson_reader.hpp>
#include <ddacontact/scene/json_parser.hpp>
#include <ddacontact/scene/polygon_builder.hpp>
#include <ddacontact/scene/spelling.hpp>

#include <algorithm>
#include <iterator>

namespace ddacontact::scene_format {

namespace {

constexpr const char* expected_root = "expected a FeatureCollection, a Feature, a Polygon or a MultiPolygon";

class GeoJsonReader {
 public:
  explicit GeoJsonReader(ProblemList& problems) : problems_(problems), properties_(problems) {}

  GeometryBlocks read(const JsonValue& root) {
    file_.complete = read_root(root);
    return std::move(file_);
  }

 private:
  /// Whether every polygon could be told from the others.
  bool read_root(const JsonValue& root) {
    const std::optional<JsonValue> type = root.is(JsonKind::object) ? root.find("type") : std::nullopt;
    if (!type || !type->is(JsonKind::string)) {
      problems_.error(root.location(), "the file holds " + root.description() + " without a 'type'",
                      expected_root);
      return false;
    }
    if (type->text() == "FeatureCollection") return read_collection(root);
    if (type->text() == "Feature")
      read_feature(root, "the feature");
    else
      read_geometry(root, "the geometry", file_.blocks);
    return true;
  }

  bool read_collection(const JsonValue& root) {
    const std::optional<JsonValue> features = root.find("features");
    if (!features || !features->is(JsonKind::array)) {
      problems_.error(
          features.value_or(root).location(),
          features ? "'features' is " + features->description() : "the FeatureCollection has no 'features'",
          "expected an array of features");
      return false;
    }
    int index = 0;
    const std::vector<JsonValue> all = features->elements();
    file_.blocks.reserve(all.size());
    for (const JsonValue& feature : all) read_feature(feature, "feature " + std::to_string(index++));
    return true;
  }

  void read_feature(const JsonValue& feature, const std::string& title) {
    const std::string expected = "expected an object with 'type' = \"Feature\", 'properties' and 'geometry'";
    if (!feature.is(JsonKind::object))
      return add_invalid(feature, title, "is " + feature.description(), expected, file_.blocks);
    if (const auto type = feature.find("type");
        !type || !type->is(JsonKind::string) || type->text() != "Feature")
      return add_invalid(type.value_or(feature), title,
                         type ? "is of 'type' " + type->description() : "has no 'type'", expected,
                         file_.blocks);
    std::vector<BlockRecord> blocks;
    const std::optional<JsonValue> geometry = feature.find("geometry");
    if (!geometry || geometry->is(JsonKind::null))
      add_invalid(geometry.value_or(feature), title, "has no geometry", "give it a Polygon or leave it out",
                  blocks);
    else
      read_geometry(*geometry, title, blocks);
    properties_.apply(feature, title, blocks);
    for (BlockRecord& block : blocks) block.locations.table = feature.location();
    std::move(blocks.begin(), blocks.end(), std::back_inserter(file_.blocks));
  }

  void read_geometry(const JsonValue& geometry, const std::string& title, std::vector<BlockRecord>& blocks) {
    const std::optional<JsonValue> type =
        geometry.is(JsonKind::object) ? geometry.find("type") : std::nullopt;
    if (!type || !type->is(JsonKind::string))
      return add_invalid(geometry, title, "has a geometry that is no object with a 'type'",
                         "expected a Polygon", blocks);
    const std::string& word = type->text();
    if (word == "GeometryCollection") return read_parts(geometry, "geometries", title, blocks);
    if (word == "MultiPolygon") return read_parts(geometry, "coordinates", title, blocks);
    if (word == "Polygon") {
      const std::optional<JsonValue> coordinates = geometry.find("coordinates");
      if (coordinates) return read_polygon(*coordinates, title, blocks);
      return add_invalid(geometry, title, "has no 'coordinates'", "expected [[[x, y], ...]]", blocks);
    }
    static const std::vector<std::string_view> known{"Polygon", "MultiPolygon", "GeometryCollection"};
    static const std::vector<std::string_view> other{"Point", "MultiPoint", "LineString", "MultiLineString"};
    const bool is_other = std::find(other.begin(), other.end(), word) != other.end();
    add_invalid(*type, title, "is a '" + excerpt(word) + "'",
                is_other ? "only polygons make blocks: leave it out" : suggestion(word, "geometry", known),
                blocks);
  }

  /// Those of a MultiPolygon are coordinates, those of a GeometryCollection geometries.
  void read_parts(const JsonValue& geometry, const char* key, const std::string& title,
                  std::vector<BlockRecord>& blocks) {
    const std::optional<JsonValue> array = geometry.find(key);
    if (!array || !array->is(JsonKind::array))
      return add_invalid(array.value_or(geometry), title, "has no array '" + std::string(key) + "'",
                         "expected an array of polygons", blocks);
    const std::vector<JsonValue> parts = array->elements();
    if (parts.empty())
      return add_invalid(*array, title, "is empty", "leave it out, or give it polygons", blocks);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::string part = parts.size() == 1 ? title : "part " + std::to_string(k) + " of " + title;
      if (std::string_view(key) == "coordinates")
        read_polygon(parts[k], part, blocks);
      else
        read_geometry(parts[k], part, blocks);
    }
  }

  void read_polygon(const JsonValue& coordinates, const std::string& title,
                    std::vector<BlockRecord>& blocks) {
    PolygonBuilder polygon(title, coordinates.location(), problems_);
    if (!coordinates.is(JsonKind::array))
      polygon.refuse(coordinates.location(), "has for rings " + coordinates.description(),
                     "expected [[[x, y], ...]]");
    else
      for (const JsonValue& ring : coordinates.elements()) read_ring(ring, polygon);
    blocks.push_back(std::move(polygon).finish());
  }

  static void read_ring(const JsonValue& ring, PolygonBuilder& polygon) {
    if (!ring.is(JsonKind::array))
      return polygon.refuse(ring.location(), "has for a ring " + ring.description(),
                            "expected [[x, y], ...]");
    polygon.begin_ring(ring.location());
    std::vector<double> coordinates;
    for (const JsonValue& vertex : ring.elements()) {
      if (!vertex.is(JsonKind::array))
        return polygon.refuse(vertex.location(), "has for a vertex " + vertex.description(),
                              "expected [x, y]");
      coordinates.clear();
      for (const JsonValue& number : vertex.elements()) {
        if (!number.is(JsonKind::number))
          return polygon.refuse(number.location(), "has for a coordinate " + number.description(),
                                "expected a number in m");
        coordinates.push_back(number.number());
      }
      polygon.add_vertex(coordinates, vertex.location());
    }
  }

  /// Says what is wrong and keeps the place of a block.
  void add_invalid(const JsonValue& value, const std::string& title, const std::string& what,
                   const std::string& cure, std::vector<BlockRecord>& blocks) {
    PolygonBuilder polygon(title, value.location(), problems_);
    polygon.refuse(value.location(), what, cure);
    blocks.push_back(std::move(polygon).finish());
  }

  ProblemList& problems_;
  FeatureProperties properties_;
  GeometryBlocks file_;
};

}  // namespace

GeometryBlocks read_geojson(const std::string& text, const std::shared_ptr<const std::string>& source,
                            ProblemList& problems) {
  const std::optional<JsonTree> tree = parse_json(text, source, problems);
  if (!tree) return {};
  return GeoJsonReader(problems).read(JsonValue(*tree));
}

}  // namespace ddacontact::scene_format
