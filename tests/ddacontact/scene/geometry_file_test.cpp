/// \file Good geometry files of every form give the blocks that [[block]] tables would.
#include "geometry_scenes.hpp"

#include <ddacontact/scene/writer.hpp>

#include <chrono>
#include <sstream>

namespace {

using namespace geometry_scenes;
using ddacontact::BlockDescription;
using ddacontact::BlockModel;
using ddacontact::Points;
using ddacontact::Vec2;

std::string written(const Scene& scene) {
  std::ostringstream out;
  ddacontact::write_scene(out, scene);
  return out.str();
}

Points unit_square() {
  Points square(2, 4);
  square << 0, 1, 1, 0, 0, 0, 1, 1;
  return square;
}

class GeometryFile : public GeometryScenes {};

TEST_F(GeometryFile, EveryFormOfGeoJsonGivesTheSameBlock) {
  const std::string rings = "[[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]]";
  const std::string polygon = R"({"type": "Polygon", "coordinates": )" + rings + "}";
  const std::string multi = R"({"type": "MultiPolygon", "coordinates": [)" + rings + "]}";
  const std::string feature = R"({"type": "Feature", "properties": null, "geometry": )" + polygon + "}";
  for (
      const std::string& text : {
          polygon,
          multi,
          R"({"type": "GeometryCollection", "geometries": [)" + polygon + "]}",
          R"({"type": "GeometryCollection", "geometries": [)" + multi + "]}",
          feature,
          R"({"geometry": )" + multi + R"(, "type": "Feature"})",
          R"({"type": "FeatureCollection", "name": "layer", "crs": {}, "features": [)" + feature + "]}",
          "\xef\xbb\xbf \r\n" + feature + "\n\n",
          std::string(
              R"({"coordinates":[[[0e0,-0.0,0],[1,0],[1.0,1,0.0],[0,1E+0],[0,0]]],"bbox":[0],"type":"Polygon"})"),
      }) {
    for (const char* name : {"a.geojson", "a.json", "b.GeoJSON"}) {
      const Scene scene = scene_with(name, text);
      ASSERT_EQ(scene.blocks.size(), 1u);
      const BlockDescription& block = scene.blocks[0];
      EXPECT_EQ(block.vertices, unit_square());
      EXPECT_EQ(block.name, "");
      EXPECT_EQ(block.material, 0);
      EXPECT_FALSE(block.fixed);
      EXPECT_TRUE(block.fixed_vertices.empty());
    }
  }
}

TEST_F(GeometryFile, EveryFormOfWktGivesTheSameBlock) {
  for (const char* text :
       {"POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))", "polygon((0 0,1 0,1 1,0 1,0 0))\n",
        "\n\n# one square\nPOLYGON\n((0 0, 1 0,\n  1 1, # the corner\n\t0 1,\r\n0 0))\n\n# end",
        "POLYGON Z ((0 0 0, 1 0 0, 1 1 0, 0 1 0, 0 0 0))", "PolygonZ((0 0 0, 1 0 0, 1 1 0, 0 1 0, 0 0 0))",
        "POLYGON ((0 0 0, 1 0 0, 1 1 0, 0 1 0, 0 0 0))", "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)))",
        "GEOMETRYCOLLECTION (POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0)))",
        "GEOMETRYCOLLECTION (GEOMETRYCOLLECTION Z (MULTIPOLYGON Z (((0 0, 1 0, 1 1, 0 1, 0 0)))))",
        "\xef\xbb\xbfPOLYGON ((-0.0 0e5, +1 .0, 1. 1E0, 0 10e-1, 0 1e-400))"}) {
    const Scene scene = scene_with("a.wkt", text);
    ASSERT_EQ(scene.blocks.size(), 1u);
    EXPECT_EQ(scene.blocks[0].vertices, unit_square());
    EXPECT_EQ(scene.blocks[0].material, 0);
  }
}

TEST_F(GeometryFile, BlocksComeInTheOrderOfTheFile) {
  const Scene json = scene_with("a.json", R"({"type": "GeometryCollection", "geometries": [
    {"type": "MultiPolygon", "coordinates": [[[[0, 0], [1, 0], [0, 1], [0, 0]]], [[[2, 0], [3, 0], [2, 1], [2, 0]]]]},
    {"type": "Polygon", "coordinates": [[[4, 0], [5, 0], [4, 1], [4, 0]]]}]})");
  const Scene wkt = scene_with("a.wkt",
                               "MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)), ((2 0, 3 0, 2 1, 2 0)))"
                               "POLYGON ((4 0, 5 0, 4 1, 4 0))");
  for (const Scene& scene : {json, wkt}) {
    ASSERT_EQ(scene.blocks.size(), 3u);
    for (int b = 0; b < 3; ++b) EXPECT_EQ(scene.blocks[b].vertices.col(0), Vec2(2 * b, 0));
  }
}

constexpr std::string_view three_features = R"({"type": "FeatureCollection", "features": [
  {"type": "Feature", "id": 7, "properties": {"name": "base", "material": "soil", "fixed": [0, 1], "fid": 1},
   "geometry": {"type": "Polygon", "coordinates": [[[0, -1], [8, -1], [8, 0], [0, 0], [0, -1]]]}},
  {"type": "Feature", "properties": {"name": "slider", "model": "affine", "material": null, "fixed": null},
   "geometry": {"type": "MultiPolygon", "coordinates": [[[[1, 2], [1, 0], [5, 0], [5.1, 2], [1, 2]]]]}},
  {"type": "Feature", "properties": {"material": 1, "model": "auto", "fixed": true},
   "geometry": {"type": "Polygon", "coordinates": [[[6, 0], [7, 0], [6.5, 0.9], [6, 0]]]}}
]})";

constexpr std::string_view three_tables = R"([[block]]
name = "base"
material = "soil"
vertices = [[0, -1], [8, -1], [8, 0], [0, 0]]
fixed = [0, 1]
[[block]]
name = "slider"
material = "rock"
vertices = [[1, 2], [1, 0], [5, 0], [5.1, 2]]
model = "affine"
[[block]]
material = "soil"
vertices = [[6, 0], [7, 0], [6.5, 0.9]]
fixed = true
)";

constexpr std::string_view actions = R"([[support]]
block = "base"
vertices = [2, 3]
[[load]]
type = "pressure"
block = "slider"
edge = 1
value = 100
[[load]]
type = "body"
block = 2
force = [1, 0]
[[monitor]]
name = "m"
block = "2"
vertex = 2
)";

TEST_F(GeometryFile, GivesTheSceneThatTablesGive) {
  const std::string rest = std::string(without_blocks) + std::string(actions);
  const Scene inline_scene = read(rest + std::string(three_tables)).scene.value();
  const Scene scene = scene_with("a.geojson", three_features, rest);
  EXPECT_EQ(written(scene), written(inline_scene));
  ASSERT_EQ(scene.blocks.size(), 3u);
  for (int b = 0; b < 3; ++b) {
    EXPECT_EQ(scene.blocks[b].vertices, inline_scene.blocks[b].vertices);
    EXPECT_EQ(scene.blocks[b].fixed_vertices, inline_scene.blocks[b].fixed_vertices);
    EXPECT_EQ(scene.blocks[b].model, inline_scene.blocks[b].model);
    EXPECT_EQ(scene.blocks[b].material, inline_scene.blocks[b].material);
  }
  EXPECT_EQ(scene.supports[0].block, 0);
  EXPECT_EQ(scene.loads[1].block, 2);
  EXPECT_EQ(scene.monitors[0].block, 2);
}

TEST_F(GeometryFile, IsNotNeededByTheSceneWrittenBack) {
  const Scene scene =
      scene_with("a.geojson", three_features, std::string(without_blocks) + std::string(actions));
  std::filesystem::remove(path("a.geojson"));
  const std::string text = written(scene);
  EXPECT_EQ(text.find("\nblocks ="), std::string::npos);
  const SceneReading again = read(text);
  ASSERT_TRUE(again.scene) << all_text(again.problems);
  EXPECT_EQ(written(*again.scene), text);
}

TEST_F(GeometryFile, BlocksFollowThoseOfTheScene) {
  const Scene scene = scene_with("a.wkt", "POLYGON ((10 0, 11 0, 10 1, 10 0))",
                                 std::string(without_blocks) + std::string(three_tables) +
                                     "[[monitor]]\nname = \"m\"\nblock = 3\nat = \"centroid\"\n");
  ASSERT_EQ(scene.blocks.size(), 4u);
  EXPECT_EQ(scene.blocks[0].name, "base");
  EXPECT_EQ(scene.blocks[3].vertices.col(0), Vec2(10, 0));
  EXPECT_EQ(scene.monitors[0].block, 3);
}

TEST_F(GeometryFile, PartsOfAFeatureShareItsProperties) {
  const Scene scene = scene_with("a.json", R"({"type": "Feature",
    "properties": {"material": "soil", "model": "affine", "fixed": true}, "geometry": {"type": "MultiPolygon",
    "coordinates": [[[[0, 0], [1, 0], [0, 1], [0, 0]]], [[[2, 0], [3, 0], [2, 1], [2, 0]]]]}})");
  ASSERT_EQ(scene.blocks.size(), 2u);
  for (const BlockDescription& block : scene.blocks) {
    EXPECT_EQ(block.material, 1);
    EXPECT_EQ(block.model, BlockModel::affine);
    EXPECT_TRUE(block.fixed);
    EXPECT_EQ(block.name, "");
  }
}

TEST_F(GeometryFile, ClockwiseRingsAreUsual) {
  const Scene scene = scene_with("a.wkt", "POLYGON ((0 0, 0 1, 1 0, 0 0))");
  EXPECT_EQ(scene.blocks[0].vertices.col(1), Vec2(0, 1));
}

TEST_F(GeometryFile, NumbersKeepEveryBit) {
  const Scene wkt = scene_with("a.wkt",
                               "POLYGON ((0.1 0.30000000000000004, 1.0000000000000002 0, 1 5e1, 0.1 "
                               "0.30000000000000004))");
  const Scene json = scene_with("a.json",
                                R"({"type": "Polygon", "coordinates": [[[0.1, 0.30000000000000004],
                                [1.0000000000000002, 0], [1, 50], [0.1, 0.30000000000000004]]]})");
  Points points(2, 3);
  points << 0.1, 1.0000000000000002, 1, 0.30000000000000004, 0, 50;
  EXPECT_EQ(wkt.blocks[0].vertices, points);
  EXPECT_EQ(json.blocks[0].vertices, points);
}

TEST_F(GeometryFile, IsLookedForBesideTheScene) {
  std::filesystem::create_directories(directory_ / "wall");
  write("wall/blocks.wkt", "POLYGON ((0 0, 1 0, 0 1, 0 0))");
  write("wall/other.wkt", "POLYGON ((0 0, 2 0, 0 1, 0 0))");
  write("wall/scene.toml", "blocks = \"blocks.wkt\"\n" + std::string(without_blocks));
  EXPECT_EQ(ddacontact::read_scene(path("wall/scene.toml")).scene.value().blocks[0].vertices(0, 1), 1);
  for (const std::string& other : {std::string("other.wkt"), path("wall/other.wkt")})
    EXPECT_EQ(ddacontact::read_scene(path("wall/scene.toml"), {"blocks=" + other})
                  .scene.value()
                  .blocks[0]
                  .vertices(0, 1),
              2);
}

/// n x n unit squares.
std::string grid(int n, bool json) {
  std::ostringstream text;
  if (json) text << R"({"type": "FeatureCollection", "features": [)";
  for (int k = 0; k < n * n; ++k) {
    const int x = k % n, y = k / n;
    if (json)
      text << (k > 0 ? ",\n" : "") << R"({"type": "Feature", "properties": {"name": "b)" << k
           << R"("}, "geometry": {"type": "Polygon", "coordinates": [[[)" << x << ',' << y << "],[" << x + 1
           << ',' << y << "],[" << x + 1 << ',' << y + 1 << "],[" << x << ',' << y + 1 << "],[" << x << ','
           << y << "]]]}}";
    else
      text << "POLYGON ((" << x << ' ' << y << ", " << x + 1 << ' ' << y << ", " << x + 1 << ' ' << y + 1
           << ", " << x << ' ' << y + 1 << ", " << x << ' ' << y << "))\n";
  }
  if (json) text << "]}";
  return text.str();
}

TEST_F(GeometryFile, IsReadInTimeLinearInItsSize) {
  for (const bool json : {true, false}) {
    const auto seconds = [&](int n) {
      const std::string text = grid(n, json);
      const auto start = std::chrono::steady_clock::now();
      EXPECT_EQ(scene_with(json ? "a.json" : "a.wkt", text).blocks.size(), static_cast<std::size_t>(n * n));
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const double small = seconds(50);
    EXPECT_LT(seconds(100), 10 * 4 * small);
  }
}

}  // namespace
