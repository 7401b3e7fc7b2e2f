// Cells of mesh files as blocks.
#include "geometry_scenes.hpp"

#include <polyfem/io/mesh_file.hpp>

namespace {

using namespace geometry_scenes;

class MeshBlocks : public GeometryScenes {};

const std::string two_cells = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "base"
2 2 "top"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 2 0 0
3 2 1 0
4 0 1 0
5 1 3 0
$EndNodes
$Elements
2
1 3 2 1 1 1 2 3 4
2 2 2 2 2 4 3 5
$EndElements
)";

TEST_F(MeshBlocks, CellsOfGmshAreBlocksInTheirPhysicalGroups) {
  const Scene scene = scene_with("mesh.msh", two_cells);
  ASSERT_EQ(scene.blocks.size(), 2u);
  ddacontact::Points quadrilateral(2, 4), triangle(2, 3);
  quadrilateral << 0, 2, 2, 0, 0, 0, 1, 1;
  triangle << 0, 2, 1, 1, 1, 3;
  EXPECT_EQ(scene.blocks[0].vertices, quadrilateral);
  EXPECT_EQ(scene.blocks[1].vertices, triangle);
  const SceneReading held =
      read_with("mesh.msh", two_cells,
                std::string(without_blocks) +
                    "[[support]]\nblock = { group = \"base\" }\nvertices = { on = [[0, 0], [2, 0]] }\n");
  ASSERT_TRUE(held.scene) << all_text(held.problems);
  ASSERT_EQ(held.scene->supports.size(), 1u);
  EXPECT_EQ(held.scene->supports[0].block, 0);
}

TEST_F(MeshBlocks, PolygonsOfVtuAreBlocks) {
  polyfem::NamedMesh named;
  named.mesh.vertices.resize(2, 6);
  named.mesh.vertices << 0, 1, 2, 2, 1, 0, 0, 0, 0, 1, 1.5, 1;
  for (const std::vector<int>& cell : {std::vector{0, 1, 4, 5}, std::vector{1, 2, 3, 4}})
    named.mesh.add_cell(cell);
  named.cell_groups["left"] = {0};
  polyfem::MeshFile(named).write(path("made.vtu"));
  const SceneReading reading = ddacontact::read_scene_text(
      "blocks = \"made.vtu\"\n" + std::string(without_blocks), "scene.toml", {}, directory_);
  ASSERT_TRUE(reading.scene) << all_text(reading.problems);
  ASSERT_EQ(reading.scene->blocks.size(), 2u);
  EXPECT_EQ(reading.scene->blocks[1].vertices, named.mesh.outline(1));
}

TEST_F(MeshBlocks, AreRefusedWithLineAndCure) {
  std::string damaged = two_cells;
  damaged.replace(damaged.find("2 2 0 0"), 7, "2 2 zero 0");
  const SceneReading reading = read_with("mesh.msh", damaged);
  ASSERT_EQ(reading.problems.size(), 1u) << all_text(reading.problems);
  const std::string text = reading.problems[0].text();
  EXPECT_NE(text.find("mesh.msh:12:1: error: \"zero\" is no finite number (give"), std::string::npos) << text;
}

}  // namespace
