/// \file Every way in which a geometry file may be wrong that the readers know: the place, the words, one
/// problem only.
#include "geometry_scenes.hpp"

#include <algorithm>
#include <ostream>

namespace {

using namespace geometry_scenes;

struct Case {
  const char* name;
  const char* from;  ///< in the good file
  const char* to;
  int line, column;
  std::vector<const char*> words;  ///< all stand in the message
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

constexpr std::string_view good_json = R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"name": "base", "fixed": [0, 1]}, "geometry":
  {"type": "Polygon", "coordinates": [[[0, -1], [8, -1], [8, 0], [0, 0], [0, -1]]]}},
{"type": "Feature", "properties": {"name": "slider", "material": "soil", "model": "affine"}, "geometry":
  {"type": "MultiPolygon", "coordinates": [[[[1, 0], [5, 0], [5, 2], [1, 2], [1, 0]]]]}}
]})";

const Case json_cases[] = {
    // JSON itself.
    {"CutOff", "[1, 2], [1, 0]]]]}}\n]}", "", 5, 70, {"not JSON", "ends too early"}},
    {"NoColon", "\"features\": [", "\"features\" [", 1, 42, {"not JSON at '['"}},
    {"Word", "[5, 2]", "[5, two]", 5, 66, {"not JSON at 'two'"}},
    {"NaN", "[5, 2]", "[5, NaN]", 5, 66, {"not JSON at 'NaN'", "finite"}},
    {"Infinity", "[5, 2]", "[5, -Infinity]", 5, 66, {"not JSON at '-Infinity'", "finite"}},
    {"Overflow", "[5, 2]", "[5, 1e400]", 5, 66, {"1e400"}},
    {"Comment",
     "{\"type\": \"FeatureCollection\"",
     "// wall\n{\"type\": \"FeatureCollection\"",
     1,
     1,
     {"not JSON"}},
    {"TrailingComma", "}}\n]}", "}},\n]}", 6, 1, {"not JSON at ']'"}},
    {"TwoTexts", "\n]}", "\n]}{}", 6, 3, {"not JSON at '{'"}},
    {"NotUtf8", "slider", "sl\xffider", 4, 44, {"not JSON", "UTF-8"}},
    {"KeyTwice", "\"material\"", "\"name\"", 4, 54, {"'name'", "twice"}},
    {"Nested",
     "[5, 2]",
     "[5, "
     "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[2]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]"
     "]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]",
     5,
     122,
     {"nested", "64"}},

    // What is no GeoJSON.
    {"UnknownRoot", "\"FeatureCollection\"", "\"Topology\"", 1, 10, {"'Topology'", "Polygon"}},
    {"RootWithoutType",
     "\"type\": \"FeatureCollection\"",
     "\"kind\": 3",
     1,
     1,
     {"without a 'type'", "FeatureCollection"}},
    {"NoFeatures", "\"features\"", "\"feature\"", 1, 1, {"no 'features'"}},
    {"FeatureIsNumber", "[\n", "[3,\n", 1, 44, {"feature 0", "'3'"}},
    {"FeatureWithoutType",
     "{\"type\": \"Feature\", \"properties\": {\"name\": \"base\"",
     "{\"properties\": {\"name\": \"base\"",
     2,
     1,
     {"feature 0", "no 'type'"}},
    {"FeatureOfOtherType",
     "\"Feature\", \"properties\": {\"name\": \"base\"",
     "\"feature\", \"properties\": {\"name\": \"base\"",
     2,
     10,
     {"feature 0", "'feature'"}},
    {"NoGeometry",
     "{\"type\": \"Polygon\", \"coordinates\": [[[0, -1], [8, -1], [8, 0], [0, 0], [0, -1]]]}",
     "null",
     3,
     3,
     {"feature 0", "no geometry"}},
    {"GeometryIsNumber",
     "{\"type\": \"Polygon\", \"coordinates\": [[[0, -1], [8, -1], [8, 0], [0, 0], [0, -1]]]}",
     "3",
     3,
     3,
     {"feature 0", "geometry"}},
    {"NoCoordinates",
     "\"Polygon\", \"coordinates\"",
     "\"Polygon\", \"coords\"",
     3,
     3,
     {"feature 0", "'coordinates'"}},
    {"NoParts",
     "\"MultiPolygon\", \"coordinates\"",
     "\"MultiPolygon\", \"coords\"",
     5,
     3,
     {"feature 1", "'coordinates'"}},
    {"Line", "\"Polygon\"", "\"LineString\"", 3, 12, {"feature 0", "'LineString'", "only polygons"}},
    {"Points", "\"Polygon\"", "\"MultiPoint\"", 3, 12, {"feature 0", "'MultiPoint'", "only polygons"}},
    {"MisspeltGeometry", "\"Polygon\"", "\"Polygn\"", 3, 12, {"'Polygn'", "did you mean 'Polygon'?"}},

    // Rings.
    {"Empty", "[[[0, -1], [8, -1], [8, 0], [0, 0], [0, -1]]]", "[]", 3, 38, {"feature 0", "empty"}},
    {"EmptyRing", "[[[0, -1], [8, -1], [8, 0], [0, 0], [0, -1]]]", "[[]]", 3, 39, {"feature 0", "empty"}},
    {"EmptyMultiPolygon",
     "[[[[1, 0], [5, 0], [5, 2], [1, 2], [1, 0]]]]",
     "[]",
     5,
     43,
     {"feature 1", "empty"}},
    {"RingIsNumber", "[[[0, -1], [8, -1], [8, 0], [0, 0], [0, -1]]]", "[3]", 3, 39, {"feature 0", "'3'"}},
    {"RingsAreNumber", "[[[0, -1], [8, -1], [8, 0], [0, 0], [0, -1]]]", "3", 3, 38, {"feature 0", "'3'"}},
    {"VertexIsNumber", "[5, 2]", "5", 5, 62, {"feature 1", "'5'", "[x, y]"}},
    {"CoordinateIsWord", "[5, 2]", "[5, \"2 m\"]", 5, 66, {"feature 1", "'2 m'", "in m"}},
    {"OneCoordinate", "[5, 2]", "[5]", 5, 62, {"feature 1", "vertex 2", "x and y"}},
    {"FourCoordinates", "[5, 2]", "[5, 2, 0, 0]", 5, 62, {"feature 1", "vertex 2", "x and y"}},
    {"ThirdCoordinate", "[5, 2]", "[5, 2, 1.5]", 5, 62, {"feature 1", "vertex 2", "'1.5'", "must be 0"}},
    {"HugeCoordinate", "[5, 2]", "[5, 2e60]", 5, 62, {"feature 1", "vertex 2", "'2e+60'", "too large"}},
    {"NotClosed", "[1, 2], [1, 0]", "[1, 2]", 5, 70, {"feature 1", "not closed", "first vertex"}},
    {"NearlyClosed", "[1, 2], [1, 0]", "[1, 2], [1, 1e-15]", 5, 78, {"feature 1", "not closed"}},
    {"OneVertex", "[1, 0], [5, 0], [5, 2], [1, 2], [1, 0]", "[1, 0]", 5, 46, {"feature 1", "not closed"}},
    {"TwoVertices",
     "[1, 0], [5, 0], [5, 2], [1, 2], [1, 0]",
     "[1, 0], [5, 0], [1, 0]",
     5,
     44,
     {"block 'slider' of feature 1", "has 2 vertices", "three"}},
    {"Hole",
     "[0, -1]]]",
     "[0, -1]], [[1, -0.5], [2, -0.5], [1, -0.1], [1, -0.5]]]",
     3,
     84,
     {"feature 0", "hole"}},
    {"Concave",
     "\"affine\"}, \"geometry\":\n  {\"type\": \"MultiPolygon\", \"coordinates\": [[[[1, 0], [5, 0], [5, 2]",
     "\"wachspress\"}, \"geometry\":\n  {\"type\": \"MultiPolygon\", \"coordinates\": [[[[1, 0], [5, 0], "
     "[1.5, 0.5]",
     5,
     62,
     {"block 'slider' of feature 1", "concave", "vertex 2"}},
    {"Straight",
     "\"affine\"}, \"geometry\":\n  {\"type\": \"MultiPolygon\", \"coordinates\": [[[[1, 0], [5, 0], [5, 2]",
     "\"wachspress\"}, \"geometry\":\n  {\"type\": \"MultiPolygon\", \"coordinates\": [[[[1, 0], [5, 0], [5, "
     "2], "
     "[3, 2]",
     5,
     70,
     {"block 'slider' of feature 1", "straight", "vertex 3"}},
    {"Touching",
     "[5, 2]",
     "[3, 0]",
     5,
     54,
     {"block 'slider' of feature 1", "runs back on itself", "vertex 1"}},
    {"VertexTwice",
     "[5, 2],",
     "[5, 2], [5, 2],",
     5,
     70,
     {"block 'slider' of feature 1", "vertex 2", "vertex 3"}},
    {"SelfIntersection",
     "[5, 2], [1, 2]",
     "[1, 2], [5, 2]",
     5,
     70,
     {"block 'slider' of feature 1", "intersects"}},
    {"Overlap",
     "[1, 0], [5, 0], [5, 2], [1, 2], [1, 0]",
     "[1, -0.5], [5, -0.5], [5, 2], [1, 2], [1, -0.5]",
     5,
     44,
     {"block 'slider' of feature 1 overlaps block 'base' of feature 0 by 0.5 m"}},

    // Properties.
    {"PropertiesAreNumber",
     "{\"name\": \"slider\", \"material\": \"soil\", \"model\": \"affine\"}",
     "3",
     4,
     35,
     {"'properties' of feature 1", "'3'"}},
    {"NameIsNumber", "\"slider\"", "12", 4, 44, {"'name' of feature 1", "'12'", "a string"}},
    {"EmptyName", "\"slider\"", "\"\"", 4, 44, {"'name'", "empty"}},
    {"NameOfTwoLines", "\"slider\"", "\"a\\nb\"", 4, 44, {"'name'", "control"}},
    {"NameTwice", "\"slider\"", "\"base\"", 4, 44, {"'base' of feature 1", "taken by block 0"}},
    {"UnknownMaterial", "\"soil\"", "\"sol\"", 4, 66, {"unknown material 'sol' of feature 1", "'soil'"}},
    {"UnknownMaterialIndex", "\"soil\"", "2", 4, 66, {"unknown material '2' of feature 1", "0 to 1"}},
    {"MaterialIsFraction",
     "\"soil\"",
     "0.5",
     4,
     66,
     {"'material' of feature 1", "'0.5'", "a name or an index"}},
    {"MaterialIsObject", "\"soil\"", "{}", 4, 66, {"'material' of feature 1", "an object"}},
    {"UnknownModel", "\"affine\"", "\"afine\"", 4, 83, {"'model' = 'afine' of feature 1", "'affine'"}},
    {"ModelIsFlag", "\"affine\"", "true", 4, 83, {"'model' of feature 1", "'true'", "wachspress"}},
    {"FixedIsWord", "[0, 1]", "\"yes\"", 2, 61, {"'fixed' of feature 0", "'yes'", "true, false"}},
    {"FixedIsNumber", "[0, 1]", "1", 2, 61, {"'fixed' of feature 0", "'1'"}},
    {"FixedHoldsWord", "[0, 1]", "[0, \"1\"]", 2, 65, {"'fixed' of feature 0", "'1'", "index"}},
    {"FixedHoldsFraction", "[0, 1]", "[0, 1.5]", 2, 65, {"'fixed' of feature 0", "'1.5'", "index"}},
    {"FixedHoldsNegative", "[0, 1]", "[0, -1]", 2, 65, {"'fixed' of feature 0", "'-1'", "index"}},
    {"NoSuchVertex", "[0, 1]", "[0, 4]", 2, 61, {"block 'base' of feature 0", "no vertex '4'", "0 to 3"}},
    {"FixedTwice", "[0, 1]", "[0, 0]", 2, 61, {"vertex '0'", "twice"}},
    {"NameOfSeveral",
     "[1, 0]]]]",
     "[1, 0]]], [[[6, 0], [7, 0], [6, 1], [6, 0]]]]",
     4,
     44,
     {"'name' = 'slider' of feature 1", "2 polygons"}},
};

constexpr std::string_view good_wkt = R"(# a wall
POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))
MULTIPOLYGON (((1 0, 5 0, 5 2, 1 2, 1 0)),
              ((6 0, 7 0, 6 1, 6 0)))
)";

const Case wkt_cases[] = {
    {"CutOff", "6 1, 6 0)))\n", "6 1", 4, 30, {"ends too early", "','"}},
    {"CutOffAtWord",
     "((0 -1, 8 -1, 8 0, 0 0, 0 -1))\nMULTIPOLYGON (((1 0, 5 0, 5 2, 1 2, 1 0)),\n              "
     "((6 0, 7 0, 6 1, 6 0)))\n",
     "",
     2,
     9,
     {"ends too early", "'('"}},
    {"NoWord", "POLYGON ((0", "((0", 2, 1, {"not WKT at '('", "POLYGON"}},
    {"Quoted",
     "POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))",
     "\"POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))\"",
     2,
     1,
     {"not WKT at '\"POLYGON'", "expected POLYGON"}},
    {"OtherText", "POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))", "x,y", 2, 1, {"not WKT at 'x'"}},
    {"Word", "5 2", "5 two", 3, 29, {"not WKT at 'two'"}},
    {"NoComma", "5 0, 5 2", "5 0; 5 2", 3, 25, {"not WKT at ';'"}},
    {"TwoCommas", "5 0, 5 2", "5 0,, 5 2", 3, 26, {"not WKT at ','", "number"}},
    {"BracketMissing", "((6 0", "(6 0", 4, 16, {"not WKT at '6'", "'('"}},
    {"BracketTooMany", "6 0)))", "6 0))))", 4, 38, {"not WKT at ')'"}},
    {"Srid", "POLYGON ((0", "SRID=4326;POLYGON ((0", 2, 1, {"'SRID=4326'", "in m"}},
    {"Point",
     "POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))",
     "Point (3 4)",
     2,
     1,
     {"geometry 0", "'Point'", "only polygons"}},
    {"EmptyLine",
     "POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))",
     "LINESTRING EMPTY",
     2,
     1,
     {"geometry 0", "'LINESTRING'", "only polygons"}},
    {"Misspelt", "MULTIPOLYGON", "MULTPOLYGON", 3, 1, {"geometry 1", "'MULTPOLYGON'", "'MULTIPOLYGON'"}},
    {"Measured", "POLYGON ((0", "POLYGON M ((0", 2, 1, {"geometry 0", "'M'", "two-dimensional"}},
    {"MeasuredToo", "POLYGON ((0", "POLYGONZM ((0", 2, 1, {"geometry 0", "'ZM'", "two-dimensional"}},
    {"Empty", "((0 -1, 8 -1, 8 0, 0 0, 0 -1))", "EMPTY", 2, 1, {"geometry 0", "empty"}},
    {"EmptyRing", "((0 -1, 8 -1, 8 0, 0 0, 0 -1))", "(EMPTY)", 2, 10, {"geometry 0", "empty"}},
    {"EmptyCollection",
     "POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))",
     "GEOMETRYCOLLECTION empty",
     2,
     1,
     {"geometry 0", "empty"}},
    {"LineInCollection",
     "POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))",
     "GEOMETRYCOLLECTION (LINESTRING (0 0, 1 1))",
     2,
     21,
     {"part 0 of geometry 0", "'LINESTRING'"}},
    {"NotClosed", "1 2, 1 0)", "1 2)", 3, 32, {"part 0 of geometry 1", "not closed"}},
    {"NaN", "7 0", "7 nan", 4, 22, {"part 1 of geometry 1", "vertex 1", "'nan'"}},
    {"Infinite", "7 0", "7 -Infinity", 4, 22, {"part 1 of geometry 1", "'-inf'"}},
    {"Overflow", "7 0", "7 1e400", 4, 22, {"part 1 of geometry 1", "not a finite number"}},
    {"Huge", "7 0", "7 2e60", 4, 22, {"part 1 of geometry 1", "'2e+60'", "too large"}},
    {"OneCoordinate", "7 0", "7", 4, 22, {"part 1 of geometry 1", "vertex 1", "x and y"}},
    {"FourCoordinates", "7 0", "7 0 0 0", 4, 22, {"part 1 of geometry 1", "vertex 1", "x and y"}},
    {"ThirdCoordinate", "7 0", "7 0 1", 4, 22, {"part 1 of geometry 1", "vertex 1", "'1'", "must be 0"}},
    {"Hole", "0 -1))", "0 -1), (1 -0.5, 2 -0.5, 1 -0.1, 1 -0.5))", 2, 40, {"geometry 0", "hole"}},
    {"Touching", "5 2", "3 0", 3, 22, {"block 1 of part 0 of geometry 1", "runs back on itself", "vertex 1"}},
    {"SelfIntersection", "5 2, 1 2", "1 2, 5 2", 3, 32, {"block 1 of part 0 of geometry 1", "intersects"}},
    {"TwoVertices", "6 1, 6 0", "6 0", 4, 15, {"block 2 of part 1 of geometry 1", "has 2 vertices"}},
};

class BadGeometry : public GeometryScenes, public testing::WithParamInterface<Case> {
 protected:
  void expect_refused(const std::string& file, std::string_view good) {
    const Case& c = GetParam();
    ASSERT_TRUE(read_with(file, good).scene);
    const SceneReading reading = read_with(file, replaced(good, c.from, c.to));
    EXPECT_FALSE(reading.scene);
    EXPECT_FALSE(reading.unreadable);
    ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
    const Problem& problem = reading.problems[0];
    EXPECT_EQ(problem.severity, Problem::Severity::error);
    EXPECT_EQ(problem.file, path(file));
    EXPECT_EQ(problem.line, c.line) << problem.text();
    EXPECT_EQ(problem.column, c.column) << problem.text();
    EXPECT_FALSE(problem.cure.empty()) << problem.text();
    for (const char* word : c.words)
      EXPECT_NE(problem.text().find(word), std::string::npos) << word << " in " << problem.text();
  }
};

class BadGeoJson : public BadGeometry {};
TEST_P(BadGeoJson, IsRefusedAtItsPlaceWithItsWords) {
  expect_refused("wall.geojson", good_json);
}
INSTANTIATE_TEST_SUITE_P(All, BadGeoJson, testing::ValuesIn(json_cases),
                         [](const auto& test) { return std::string(test.param.name); });

class BadWkt : public BadGeometry {};
TEST_P(BadWkt, IsRefusedAtItsPlaceWithItsWords) {
  expect_refused("wall.wkt", good_wkt);
}
INSTANTIATE_TEST_SUITE_P(All, BadWkt, testing::ValuesIn(wkt_cases),
                         [](const auto& test) { return std::string(test.param.name); });

class GeometryProblems : public GeometryScenes {};

TEST_F(GeometryProblems, AreAllNamedInTheOrderOfTheFile) {
  const SceneReading reading = read_with("a.wkt",
                                         "POINT (1 2)\nPOLYGON EMPTY\nPOLYGON ((0 0, 1 0, 1 1))\n"
                                         "POLYGON ((0 0, 4 0, 2 0, 0 4, 0 0))\n"
                                         "POLYGON ((0 0, 1 0, 2 2, 0 0), (0 0, 1 1, 0 1, 0 0))\n",
                                         replaced(without_blocks, "steps = 1", "steps = 0"));
  std::vector<std::string> locations;
  for (const Problem& problem : reading.problems)
    locations.push_back(problem.file.substr(problem.file.rfind('/') + 1) + ':' +
                        std::to_string(problem.line));
  EXPECT_EQ(locations,
            (std::vector<std::string>{"scene.toml:3", "a.wkt:1", "a.wkt:2", "a.wkt:3", "a.wkt:4", "a.wkt:5"}))
      << all_text(reading.problems);
}

TEST_F(GeometryProblems, OfPolygonsLeaveTheOthersTheirNamesAndIndices) {
  const SceneReading reading = read_with(
      "wall.geojson", replaced(good_json, "\"Polygon\"", "\"LineString\""),
      std::string(without_blocks) + "[[monitor]]\nname = \"a\"\nblock = \"base\"\nat = \"centroid\"\n" +
          "[[monitor]]\nname = \"b\"\nblock = 1\nat = [2, 1]\n");
  EXPECT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
}

constexpr const char* watched = "[[monitor]]\nname = \"a\"\nblock = \"base\"\nat = \"centroid\"\n";

TEST_F(GeometryProblems, OfTheWholeFileBringNoUnknownBlocksAlong) {
  const std::string rest = std::string(without_blocks) + watched;
  for (const char* text : {"", "{", "3", R"({"type": "FeatureCollection", "features": []})"})
    EXPECT_EQ(read_with("a.json", text, rest).problems.size(), 1u) << text;
  for (const char* text : {"", "\n# nothing\n", "POLYGON", "x"})
    EXPECT_EQ(read_with("a.wkt", text, rest).problems.size(), 1u) << text;
}

TEST_F(GeometryProblems, OfAMissingFileStandAtItsKey) {
  std::filesystem::create_directories(directory_ / "folder.wkt");
  for (const char* name : {"missing.geojson", "missing.wkt", "folder.wkt", "no/such.json"}) {
    const std::string text =
        "blocks = \"" + std::string(name) + "\"\n" + std::string(without_blocks) + watched;
    const SceneReading reading = ddacontact::read_scene_text(text, "scene.toml", {}, directory_);
    EXPECT_TRUE(reading.unreadable);
    EXPECT_FALSE(reading.scene);
    ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
    EXPECT_EQ(
        reading.problems[0].text().find("scene.toml:1:10: error: 'blocks' = '" + path(name) + "' cannot"), 0u)
        << reading.problems[0].text();
  }
}

TEST_F(GeometryProblems, NamesAreUniqueAmongTablesAndFeatures) {
  const SceneReading reading = read_with(
      "wall.geojson", good_json,
      std::string(without_blocks) +
          "[[block]]\nname = \"slider\"\nmaterial = \"rock\"\nvertices = [[9, 9], [10, 9], [9, 10]]\n");
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  EXPECT_EQ(reading.problems[0].file, path("wall.geojson"));
  EXPECT_EQ(reading.problems[0].line, 4);
  EXPECT_NE(reading.problems[0].text().find("'slider' of feature 1 is taken by block 0"), std::string::npos);
}

TEST_F(GeometryProblems, ListsOfVerticesAreForOnePolygon) {
  const SceneReading reading = read_with(
      "a.json", R"({"type": "Feature", "properties": {"fixed": [0]}, "geometry": {"type": "MultiPolygon",
      "coordinates": [[[[0, 0], [1, 0], [0, 1], [0, 0]]], [[[2, 0], [3, 0], [2, 1], [2, 0]]]]}})");
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_NE(reading.problems[0].text().find("'fixed' of the feature is for 2 polygons"), std::string::npos);
}

TEST_F(GeometryProblems, PropertiesNearlyRightAreWarnedOfOnce) {
  const auto feature = [](int x, const std::string& properties) {
    const auto at = [&](int dx, int y) {
      return '[' + std::to_string(x + dx) + ',' + std::to_string(y) + ']';
    };
    return R"({"type": "Feature", "fixed": true, "properties": {)" + properties +
           R"(}, "geometry": {"type": "Polygon", "coordinates": [[)" + at(0, 0) + ',' + at(1, 0) + ',' +
           at(0, 1) + ',' + at(0, 0) + "]]}}";
  };
  const std::string odd = R"("materal": "soil", "Name": "a", "velocity": [1, 0], "fid": 3, "area": 0.5)";
  const SceneReading reading =
      read_with("a.json", R"({"type": "FeatureCollection", "name": "layer", "features": [)" +
                              feature(0, odd) + ",\n" + feature(2, odd) + "]}");
  EXPECT_TRUE(reading.scene);
  ASSERT_EQ(reading.problems.size(), 4u) << all_text(reading.problems);
  for (const Problem& problem : reading.problems) {
    EXPECT_EQ(problem.severity, Problem::Severity::warning);
    EXPECT_EQ(problem.line, 1);
    EXPECT_NE(problem.text().find("feature 0"), std::string::npos);
  }
  const std::string text = all_text(reading.problems);
  for (const char* words : {"did you mean 'material'?", "did you mean 'name'?", "belongs into a [[block]]",
                            "inside 'properties'"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
}

TEST_F(GeometryProblems, SettingsDoNotReachTheFile) {
  for (const std::string& rest :
       {std::string(without_blocks), std::string(without_blocks) +
                                         "[[block]]\nname = \"top\"\nmaterial = \"rock\"\n" +
                                         "vertices = [[9, 9], [10, 9], [9, 10]]\n"}) {
    const SceneReading reading = read_with("wall.geojson", good_json, rest, {"block.slider.model=affine"});
    ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
    EXPECT_EQ(reading.problems[0].file, "--set block.slider.model=affine");
    EXPECT_NE(reading.problems[0].text().find("do not reach the blocks of a geometry file"),
              std::string::npos);
  }
}

TEST_F(GeometryProblems, OfDeepNestingEndTheReading) {
  std::string wkt, json;
  for (int i = 0; i < 100000; ++i) {
    wkt += "GEOMETRYCOLLECTION (";
    json += R"({"type": "GeometryCollection", "geometries": [)";
  }
  for (const SceneReading& reading : {read_with("a.wkt", wkt), read_with("a.json", json)}) {
    EXPECT_FALSE(reading.scene);
    ASSERT_EQ(reading.problems.size(), 1u);
    EXPECT_NE(reading.problems[0].text().find("64"), std::string::npos) << reading.problems[0].text();
  }
}

TEST_F(GeometryProblems, AnEmptyNameIsNoFile) {
  const SceneReading reading = ddacontact::read_scene_text("blocks = \"\"\n" + std::string(without_blocks),
                                                           "scene.toml", {}, directory_);
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  EXPECT_NE(reading.problems[0].text().find("known: .geojson, .json, .wkt"), std::string::npos);
}

}  // namespace
