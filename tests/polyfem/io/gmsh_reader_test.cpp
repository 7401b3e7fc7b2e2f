#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/io/gmsh_reader.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <tests/support/text_files.hpp>

#include <gtest/gtest.h>

using namespace polyfem;
using support::file_of, support::message_of, support::replaced;

namespace {

// 4-----3-----6   the square is rock, the two triangles are soil, and the clockwise one of them wet as well;
// |  1  | 2 / |   the left and the right side have names, the line between the materials has a number.
// 1-----2-----5   Node 7 belongs to nothing.
const std::string version_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
5
1 11 "left side"
1 12 "right"
2 1 "rock"
2 2 "soil"
2 3 "wet"
$EndPhysicalNames
$Nodes
7
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
7 9 9 0
5 2 0 0
6 2 1 0
$EndNodes
$Elements
8
8 15 2 0 1 1
1 1 2 11 1 1 4
2 1 2 12 2 5 6
3 1 2 13 2 2 3
4 3 2 1 1 1 2 3 4
5 2 2 2 2 2 5 6
6 2 2 2 2 2 3 6
7 2 2 3 2 2 3 6
$EndElements
)";

const std::string version_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
5
1 11 "left side"
1 12 "right"
2 1 "rock"
2 2 "soil"
2 3 "wet"
$EndPhysicalNames
$Entities
1 4 3 0
1 0 0 0 0
1 0 0 0 0 1 0 1 11 2 1 -2
2 2 0 0 2 1 0 1 12 2 1 -2
3 1 0 0 1 1 0 1 13 2 1 -2
4 0 0 0 1 0 0 0 2 1 -2
1 0 0 0 1 1 0 1 1 4 1 2 3 4
2 1 0 0 2 1 0 1 2 4 1 2 3 4
3 1 0 0 2 1 0 2 2 3 4 1 2 3 4
$EndEntities
$Nodes
2 7 1 7
0 1 0 1
1
0 0 0
2 1 0 6
2
3
4
7
5
6
1 0 0
1 1 0
0 1 0
9 9 0
2 0 0
2 1 0
$EndNodes
$Elements
7 8 1 8
0 1 15 1
8 1
1 1 1 1
1 1 4
1 2 1 1
2 5 6
1 3 1 1
3 2 3
2 1 3 1
4 1 2 3 4
2 2 2 1
5 2 5 6
2 3 2 1
6 2 3 6
$EndElements
)";

class GmshReader : public testing::TestWithParam<const char*> {
 protected:
  std::string text() const { return GetParam() == std::string("2.2") ? version_2 : version_4; }
  std::string refusal(std::string_view from, std::string_view to) {
    return message_of([&] { read_gmsh(file_of("gmsh_reader_test.msh", replaced(text(), from, to))); });
  }
};
INSTANTIATE_TEST_SUITE_P(Versions, GmshReader, testing::Values("2.2", "4.1"),
                         [](const auto& version) { return version.index == 0 ? "2_2" : "4_1"; });

TEST_P(GmshReader, GivesCellsVerticesAndTheirGroups) {
  const NamedMesh named = read_gmsh(file_of("gmsh_reader_test.msh", text()));
  EXPECT_TRUE(find_defects(named.mesh).empty()) << "node 7 is left out, and the clockwise triangle turned";
  ASSERT_EQ(named.mesh.n_cells(), 3);
  EXPECT_EQ(named.mesh.vertices.cols(), 6);
  EXPECT_EQ(signed_area(named.mesh.outline(0)), 1);
  EXPECT_EQ(signed_area(named.mesh.outline(2)), 0.5);
  EXPECT_EQ(named.cell_groups.size(), 3u);
  EXPECT_EQ(named.cells("rock"), std::vector{0});
  EXPECT_EQ(named.cells("soil"), (std::vector{1, 2}));
  EXPECT_EQ(named.cells("wet"), std::vector{2});
}

TEST_P(GmshReader, TurnsEdgesIntoTheDirectionOfTheirCell) {
  const NamedMesh named = read_gmsh(file_of("gmsh_reader_test.msh", text()));
  const Points& x = named.mesh.vertices;
  ASSERT_EQ(named.edges("left side").size(), 1u);
  const auto [top, bottom] = named.edges("left side")[0];
  EXPECT_EQ(x.col(top), Vec2(0, 1));
  EXPECT_EQ(x.col(bottom), Vec2(0, 0));
  EXPECT_EQ(named.vertices("right").size(), 2u);
  EXPECT_EQ(named.edges("13").size(), 1u) << "a group without a name has its number";
  FieldProblem problem(named.mesh, 2);
  for (const auto& [name, edges] : named.edge_groups)
    problem.add_edge_loads(edges, [](const Vec2&, const Vec2& n) { return n; });
}

TEST_P(GmshReader, SaysFileLineAndCureOfWhatItRefuses) {
  const auto expect = [&](std::string_view from, std::string_view to, std::string_view line_and_words) {
    const std::string message = refusal(from, to);
    EXPECT_NE(message.find("gmsh_reader_test.msh:" + std::string(line_and_words)), std::string::npos)
        << message;
  };
  expect(std::string(GetParam()) + " 0", "4.0 0", "2: version 4.0");
  expect(" 0 8", " 1 8", "2: the file is binary");
  expect("2 3 \"wet\"", "2 4 \"dry\"", "10: the group \"dry\" has no cells");
  expect("1 12 \"right\"", "1 14 \"right\"", "7: the group \"right\" has no edges");
  expect("\"rock\"", "rock", "8: the group's name is not quoted");
}

TEST(GmshFile, IsRefusedWhereItIsDamaged) {
  const auto expect = [](std::string_view from, std::string_view to, std::string_view line_and_words) {
    const std::string message =
        message_of([&] { read_gmsh(file_of("damaged.msh", replaced(version_2, from, to))); });
    EXPECT_NE(message.find("damaged.msh:" + std::string(line_and_words)), std::string::npos) << message;
  };
  expect("$MeshFormat", "$Mesh", "1: a .msh file starts with");
  expect("6 2 1 0\n", "6 2 1 0.5\n", "20: node 6 is not in the plane");
  expect("5 2 0 0\n", "4 2 0 0\n", "19: node 4 is there twice");
  expect("5 2 0 0\n", "5 2 x 0\n", "19: \"x\" is no finite number");
  expect("2 1 0 0\n", "2 1 0\n", "15: the line ends too early");
  expect("1 2 3 4\n", "1 2 3 8\n", "28: there is no node 8");
  expect("4 3 2 1", "4 16 2 1", "28: elements of type 16 are of second order");
  expect("4 3 2 1", "4 5 2 1", "28: elements of type 5 are neither");
  expect("12 2 5 6", "12 2 1 6", "26: the line from node 1 to node 6");
  expect("$Elements\n8", "$Elements\n7", "31: \"7 2 2 3 2 2 3 6\" stands where $EndElements");
  expect("$EndElements\n", "", "31: the file ends");
  EXPECT_NE(message_of([] { read_gmsh("not_there.msh"); }).find("not_there.msh"), std::string::npos);
}

}  // namespace
