/// \file Problems of a geometry file: all of them, in order, and none that follows from another;
/// bad_input_test.cpp has each alone.
#include "geometry_scenes.hpp"

#include <algorithm>

namespace {

using namespace geometry_scenes;

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
