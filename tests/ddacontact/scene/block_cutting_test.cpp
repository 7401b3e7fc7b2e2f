// Blocks read from a file, cut, written and read again.

#include "geometry_scenes.hpp"

#include <ddacontact/scene/block_cutting.hpp>
#include <ddacontact/scene/blocks_reader.hpp>
#include <ddacontact/scene/geometry_writer.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <tests/support/concave_polygons.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace geometry_scenes;
using namespace ddacontact;

const std::string shapes = std::string(minimal.substr(0, minimal.find("[[block]]"))) + R"(
[[block]]
name = "L"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]
model = "wachspress"
fixed = [0, 3]
velocity = [1, 2]
angular_velocity = 3
stress = [1, 2, 3]
mesh = { cells = 9 }
[[block]]
material = "rock"
vertices = [[1, 1], [1, 2], [2, 2], [2, 1]]
model = "mean_value"
fixed = true
[[block]]
name = "with a middle"
material = "rock"
vertices = [[5, 0], [6, 0], [7, 0], [7, 0.01], [7, 2], [5, 2]]
fixed = [1, 4]
)";

Scene blocks_of(const std::string& path) {
  const BlocksReading reading = read_blocks(path);
  EXPECT_TRUE(reading.scene.scene) << all_text(reading.scene.problems);
  return reading.scene.scene.value_or(Scene{});
}

double area(const Scene& scene) {
  double sum = 0;
  for (const BlockDescription& block : scene.blocks) sum += std::abs(polyfem::signed_area(block.vertices));
  return sum;
}

class BlockCutting : public GeometryScenes {
 protected:
  Scene scene() { return blocks_of(written("shapes.toml", shapes)); }
  std::string written(const std::string& name, const std::string& text) {
    write(name, text);
    return path(name);
  }
};

constexpr CutOptions convex{.shortest_edge = 0, .drop_straight = false, .convex = true};

TEST_F(BlockCutting, ReadsConcaveBlocksOfTheModelWachspress) {
  EXPECT_EQ(scene().blocks[0].model, BlockModel::wachspress);
  EXPECT_EQ(scene().blocks[1].model, BlockModel::mean_value);
  EXPECT_EQ(scene().blocks[2].model, BlockModel::automatic);
  EXPECT_FALSE(read(shapes).scene) << "it cannot be computed";
}

TEST_F(BlockCutting, SplitsConcaveBlocksAndLeavesTheOthersAsTheyAre) {
  const Scene before = scene();
  CutCounts counts;
  const Scene after = cut_blocks(before, convex, counts);
  EXPECT_EQ(counts.split, 1);
  ASSERT_EQ(after.blocks.size(), 4u);
  EXPECT_EQ(after.blocks[0].name, "L.1");
  EXPECT_EQ(after.blocks[1].name, "L.2");
  EXPECT_NEAR(area(after), area(before), 1e-14);
  EXPECT_EQ(after.blocks[2].vertices, before.blocks[1].vertices) << "clockwise as it is";
  EXPECT_EQ(after.blocks[3].name, "with a middle");
  for (const BlockDescription& block : after.blocks)
    if (polyfem::signed_area(block.vertices) > 0) {
      EXPECT_FALSE(polyfem::find_non_convex_corner(block.vertices, 1e-9));
    }
}

TEST_F(BlockCutting, PartsAreOfTheirBlock) {
  const Scene before = scene();
  const BlockDescription& whole = before.blocks[0];
  CutCounts counts;
  const Scene after = cut_blocks(before, convex, counts);
  const Vec2 centre = polyfem::area_moments(whole.vertices).centroid;
  for (int b : {0, 1}) {
    const BlockDescription& part = after.blocks[b];
    EXPECT_EQ(part.model, whole.model);
    EXPECT_EQ(part.material, whole.material);
    EXPECT_EQ(part.mesh, whole.mesh);
    EXPECT_EQ(part.stress, whole.stress);
    EXPECT_EQ(part.angular_velocity, whole.angular_velocity);
    const Vec2 arm = polyfem::area_moments(part.vertices).centroid - centre;
    EXPECT_NEAR((part.velocity - whole.velocity - 3 * Vec2(-arm.y(), arm.x())).norm(), 0, 1e-14);
    // Vertices 0 and 3 are the ends of the cut.
    ASSERT_EQ(part.fixed_vertices.size(), 2u);
    for (const int k : part.fixed_vertices)
      EXPECT_TRUE(part.vertices.col(k) == whole.vertices.col(0) ||
                  part.vertices.col(k) == whole.vertices.col(3));
  }
  EXPECT_TRUE(after.blocks[2].fixed);
}

TEST_F(BlockCutting, EdgesKeepTheirJoints) {
  Scene before = scene();
  before.joints.resize(3);
  before.blocks.resize(1);
  BlockDescription& block = before.blocks[0];
  block.edge_joints = {0, 1, 2, 0, 1, 2};
  for (const bool clockwise : {false, true}) {
    if (clockwise) {
      block.vertices = block.vertices.rowwise().reverse().eval();
      block.edge_joints = {1, 0, 2, 1, 0, 2};
    }
    CutCounts counts;
    const Scene after = cut_blocks(before, convex, counts);
    ASSERT_EQ(after.blocks.size(), 2u);
    EXPECT_EQ(counts.mixed_edges, 0);
    for (const BlockDescription& part : after.blocks) {
      std::vector<int> joints = part.edge_joints;
      ASSERT_EQ(joints.size(), 4u);
      std::ranges::rotate(joints, std::next(std::ranges::find(joints, -1)));
      EXPECT_EQ(joints, (std::vector<int>{0, 1, 2, -1})) << "the last is the cut";
    }
  }
}

TEST_F(BlockCutting, AnEdgeOnSeveralFollowsTheJointOfTheGreatestLength) {
  Scene before = scene();
  before.joints.resize(3);
  before.blocks[2].edge_joints = {0, 0, 1, 2, -1, 2};
  CutCounts straight, merged;
  EXPECT_EQ(cut_blocks(before, {.shortest_edge = 0, .drop_straight = true, .convex = false}, straight)
                .blocks[2]
                .edge_joints,
            (std::vector<int>{0, 2, -1, 2}));
  EXPECT_EQ(straight.mixed_edges, 1);
  EXPECT_EQ(cut_blocks(before, {.shortest_edge = 0.1, .drop_straight = false, .convex = false}, merged)
                .blocks[2]
                .edge_joints,
            (std::vector<int>{0, 0, 2, -1, 2}));
  EXPECT_EQ(merged.mixed_edges, 0);
}

TEST_F(BlockCutting, AStageThatTakesABlockOutTakesItsParts) {
  Scene before = scene();
  before.stages.push_back(before.stage("first"));
  before.stages.push_back(before.stage("second"));
  before.stages[0].removed = {2};
  before.stages[1].removed = {1, 0};
  CutCounts counts;
  const Scene after = cut_blocks(before, convex, counts);
  EXPECT_EQ(after.stages[0].removed, std::vector<int>{3});
  EXPECT_EQ(after.stages[1].removed, (std::vector<int>{2, 0, 1}));
}

TEST_F(BlockCutting, DropsStraightVerticesAndShortEdgesAndSaysWhatItCost) {
  const Scene before = scene();
  CutCounts straight, both;
  const Scene dropped =
      cut_blocks(before, {.shortest_edge = 0, .drop_straight = true, .convex = false}, straight);
  EXPECT_EQ(dropped.blocks[2].vertices, support::points({{5, 0}, {7, 0}, {7, 2}, {5, 2}}));
  EXPECT_EQ(dropped.blocks[2].fixed_vertices, std::vector<int>{2}) << "where vertex 4 was";
  EXPECT_EQ(straight.straight_vertices, 2);
  EXPECT_EQ(straight.lost_holds, 1);
  EXPECT_EQ(dropped.blocks[0].vertices, before.blocks[0].vertices);

  const Scene merged =
      cut_blocks(before, {.shortest_edge = 0.1, .drop_straight = false, .convex = false}, both);
  EXPECT_EQ(merged.blocks[2].vertices, support::points({{5, 0}, {6, 0}, {7, 0.005}, {7, 2}, {5, 2}}));
  EXPECT_EQ(merged.blocks[2].fixed_vertices, (std::vector<int>{1, 3}));
  EXPECT_EQ(both.short_edges, 1);
  EXPECT_EQ(both.lost_holds, 0);
}

TEST_F(BlockCutting, RefusesNamesThatAreTaken) {
  Scene scene = this->scene();
  scene.blocks[1].name = "L.2";
  CutCounts counts;
  EXPECT_THROW(cut_blocks(scene, convex, counts), Error);
}

TEST_F(BlockCutting, SurvivesAnyFile) {
  for (const auto& [name, polygon] : support::concave_polygons()) {
    Scene before = scene();
    before.blocks.resize(1);
    before.blocks[0].vertices = polygon.rowwise().reverse();
    before.blocks[0].fixed_vertices.clear();
    CutCounts counts;
    const Scene after = cut_blocks(before, convex, counts);
    EXPECT_NEAR(area(after), area(before), 1e-13) << name;
    for (const char* file : {"a.toml", "a.geojson", "a.wkt"}) {
      write_blocks(path(file), after, 0);
      const Scene again = blocks_of(path(file));
      ASSERT_EQ(again.blocks.size(), after.blocks.size()) << name << file;
      for (std::size_t b = 0; b < again.blocks.size(); ++b) {
        EXPECT_EQ(again.blocks[b].vertices, after.blocks[b].vertices);
        if (std::string(file) == "a.wkt") continue;
        EXPECT_EQ(again.blocks[b].name, after.blocks[b].name);
        EXPECT_EQ(again.blocks[b].model, after.blocks[b].model);
        EXPECT_EQ(again.blocks[b].fixed_vertices, after.blocks[b].fixed_vertices);
        EXPECT_EQ(again.materials[again.blocks[b].material].name, "rock");
      }
    }
  }
}

TEST_F(BlockCutting, KeepsWhatFeaturesSay) {
  const std::string text = R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"name": "a", "material": "soil", "model": "affine", "fixed": true},
 "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [2, 0], [0.5, 0.5], [0, 2], [0, 0]]]}},
{"type": "Feature", "properties": {"material": "rock"},
 "geometry": {"type": "Polygon", "coordinates": [[[3, 0], [4, 0], [3, 1], [3, 0]]]}},
{"type": "Feature", "properties": {},
 "geometry": {"type": "Polygon", "coordinates": [[[5, 0], [6, 0], [5, 1], [5, 0]]]}}]})";
  const BlocksReading reading = read_blocks(written("a.geojson", text));
  ASSERT_TRUE(reading.scene.scene) << all_text(reading.scene.problems);
  CutCounts counts;
  write_blocks(path("b.geojson"), cut_blocks(*reading.scene.scene, convex, counts),
               reading.n_unnamed_materials);
  const Scene again = blocks_of(path("b.geojson"));
  ASSERT_EQ(again.blocks.size(), 4u);
  for (int b : {0, 1}) {
    EXPECT_EQ(again.blocks[b].name, b == 0 ? "a.1" : "a.2");
    EXPECT_EQ(again.materials[again.blocks[b].material].name, "soil");
    EXPECT_EQ(again.blocks[b].model, BlockModel::affine);
    EXPECT_TRUE(again.blocks[b].fixed);
  }
  EXPECT_EQ(again.materials[again.blocks[2].material].name, "rock");
  EXPECT_EQ(again.blocks[3].material, 0) << "nobody named it";
  EXPECT_FALSE(again.blocks[3].fixed);
}

TEST_F(BlockCutting, BadFilesAreProblems) {
  EXPECT_TRUE(read_blocks(path("missing.toml")).scene.unreadable);
  EXPECT_TRUE(read_blocks(path("missing.wkt")).scene.unreadable);
  for (const auto& [name, text] :
       {std::pair{"a.shp", ""}, std::pair{"a.wkt", "POLYGON ((0 0, 1 0, 1 1))"},
        std::pair{"a.toml", "steps 3"}, std::pair{"b.wkt", "POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))"},
        std::pair{"a.geojson", "{}"}}) {
    const BlocksReading reading = read_blocks(written(name, text));
    EXPECT_FALSE(reading.scene.scene) << name;
    EXPECT_TRUE(has_errors(reading.scene.problems)) << name;
  }
}

}  // namespace
