// Cells of mesh files as blocks.
#include "geometry_scenes.hpp"

#include <polyfem/io/mesh_file.hpp>

namespace {

using namespace geometry_scenes;

struct Damage {
  const char *from, *to, *problem;
};

class MeshBlocks : public GeometryScenes {
 protected:
  /// The file that the text becomes with each damage, by one message.
  void expect_refused(const std::string& file, const std::string& text, const std::vector<Damage>& damages) {
    for (const auto& [from, to, problem] : damages) {
      const SceneReading reading = read_with(file, replaced(text, from, to));
      EXPECT_FALSE(reading.scene) << problem;
      ASSERT_EQ(reading.problems.size(), 1u) << problem << '\n' << all_text(reading.problems);
      EXPECT_NE(reading.problems[0].text().find(problem), std::string::npos) << reading.problems[0].text();
    }
  }
};

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

TEST_F(MeshBlocks, DamagedGmshFilesAreRefusedWithLineAndCure) {
  expect_refused(
      "mesh.msh", two_cells,
      {
          Damage{"2 2 0 0", "2 2 zero 0", ":12:1: error: \"zero\" is no finite number (give"},
          Damage{"2 2 0 0", "2 2 1e999 0", ":12:1: error: \"1e999\" is no finite number (give"},
          Damage{"2 2 0 0", "2 2 0 1", ":12:1: error: node 2 is not in the plane of the first one (give"},
          Damage{"2 2 0 0", "1 2 0 0", ":12:1: error: node 1 is there twice (number"},
          Damage{"2 2 0 0", "2 2 0", ":12:1: error: the line ends too early (give"},
          Damage{"$Nodes\n5", "$Nodes\n99999999999", ":10:1: error: \"99999999999\" is no whole number"},
          Damage{"$Nodes\n5", "$Nodes\n-5", ":10:1: error: \"-5\" is no whole number"},
          Damage{"$Nodes\n5", "$Nodes\n4", "stands where $EndNodes should (see"},
          Damage{"2 4 3 5", "2 4 3 6", ":20:1: error: there is no node 6 (add it"},
          Damage{"2 2 2 2 2 4 3 5", "2 4 2 2 2 4 3 5", "neither lines, triangles nor quadrilaterals (mesh"},
          Damage{"2.2 0", "2.2 1", ":2:1: error: the file is binary (save it as ASCII"},
          Damage{"2.2 0", "1.0 0", ":2:1: error: version 1.0 of the format is not read (save"},
          Damage{"$EndElements\n", "", "the file ends where $EndElements should follow (it is cut short"},
          Damage{two_cells.c_str(), "",
                 ":1:1: error: the file ends where $MeshFormat should follow (it is cut"},
      });
}

const std::string one_square = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 2 0 0 1 0</DataArray></Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">7</DataArray>
</Cells>
</Piece>
</UnstructuredGrid></VTKFile>
)";

TEST_F(MeshBlocks, DamagedVtuFilesAreRefusedWithLineAndCure) {
  ASSERT_TRUE(read_with("mesh.vtu", one_square).scene);
  expect_refused(
      "mesh.vtu", one_square,
      {
          Damage{"1 2 0 0", "1 x 0 0", ":4:1: error: \"x\" is no number of type Float64 (write"},
          Damage{"1 2 0 0", "1 nan 0 0", ":4:1: error: a coordinate is not finite (correct"},
          Damage{"1 2 0 0", "1 2 3 0", ":4:1: error: the points are not in one plane z = const. (give"},
          Damage{"1 2 0 0", "1 2 0", ":4:1: error: there are 11 coordinates for 4 points (give"},
          Damage{"0 1 2 3<", "0 1 2 4<", ":6:1: error: cell 0 has a vertex 4, but there are 4"},
          Damage{">4<", ">5<", ":7:1: error: cell 0 ends at 5 in the connectivity of 4"},
          Damage{">7<", ">10<", ":8:1: error: cell 0 is of VTK's type 10 (keep"},
          Damage{"NumberOfCells=\"1\"", "NumberOfCells=\"2\"",
                 ":7:1: error: there are 1 offsets and 1 types for 2"},
          Damage{"0 1 2 3<", "0 2 1 3<", "cell 0 intersects itself"},
          Damage{"</UnstructuredGrid></VTKFile>", "", "the file is damaged; write it again"},
          Damage{"UnstructuredGrid\"", "PolyData\"", "save"},
          Damage{one_square.c_str(), "", ":1:1: error: No document element found (the file is damaged"},
      });
}

}  // namespace
