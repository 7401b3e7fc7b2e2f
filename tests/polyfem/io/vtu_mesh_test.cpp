#include <polyfem/core/error.hpp>
#include <polyfem/io/mesh_file.hpp>
#include <polyfem/io/vtu_mesh.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/polyfem/io/encoded_vtu.hpp>
#include <tests/support/domains.hpp>
#include <tests/support/text_files.hpp>

#include <gtest/gtest.h>

using namespace polyfem;
using support::file_of, support::message_of, support::replaced;

namespace {

NamedMesh named_voronoi() {
  NamedMesh named{voronoi(support::l_shape(), {.n_cells = 60}), {}, {}};
  named.cell_groups["every third"] = {0, 3, 6};
  named.cell_groups["first"] = {0};
  named.edge_groups["bottom"] = boundary_edges(named.mesh, [](const Vec2& x) { return x.y() == 0; });
  return named;
}

TEST(VtuMesh, GivesBackMeshAndGroupsOfAMeshFileToTheBit) {
  const NamedMesh named = named_voronoi();
  const auto path = std::filesystem::path(testing::TempDir()) / "vtu_mesh_test.vtu";
  MeshFile file(named);
  file.add_cell_field("other", VectorXd::Ones(named.mesh.n_cells()));
  file.write(path);
  const NamedMesh read = read_vtu_mesh(path);
  EXPECT_EQ(read.mesh.vertices, named.mesh.vertices);
  EXPECT_EQ(read.mesh.offsets, named.mesh.offsets);
  EXPECT_EQ(read.mesh.indices, named.mesh.indices);
  EXPECT_EQ(read.cell_groups, named.cell_groups);
  EXPECT_EQ(read.edge_groups, named.edge_groups);
}

TEST(VtuMesh, ReadsTheEncodingsOfOtherPrograms) {
  for (const std::string& text : {encoded_vtu::ascii, encoded_vtu::base64, encoded_vtu::base64_zlib,
                                  encoded_vtu::base64_zlib_64, encoded_vtu::appended_base64}) {
    const NamedMesh named = read_vtu_mesh(file_of("encoded.vtu", text));
    EXPECT_TRUE(find_defects(named.mesh).empty());
    ASSERT_EQ(named.mesh.n_cells(), 2);
    EXPECT_EQ(named.mesh.outline(1), support::rectangle(1, 1).colwise() + Vec2(1, 0));
    EXPECT_EQ(named.cells("rock"), std::vector{0});
    EXPECT_EQ(named.edges("left"), (std::vector{std::array{3, 0}}));
  }
}

TEST(VtuMesh, SaysFileLineAndCureOfWhatItRefuses) {
  const auto expect = [](std::string_view from, std::string_view to, std::string_view line_and_words) {
    const std::string message =
        message_of([&] { read_vtu_mesh(file_of("damaged.vtu", replaced(encoded_vtu::ascii, from, to))); });
    EXPECT_NE(message.find("damaged.vtu:" + std::string(line_and_words)), std::string::npos) << message;
  };
  expect("UnstructuredGrid\" ", "PolyData\" ", "2: it holds no unstructured grid");
  expect("LittleEndian", "BigEndian", "2: its numbers are big endian");
  expect("</Points>", "</Point>", "19: Start-end tags mismatch");
  expect("9 7", "9 3", "27: cell 1 is of VTK's type 3");
  expect("4 8", "4 9", "24: cell 1 ends at 9");
  expect("1 4 5 2", "1 4 6 2", "21: cell 1 has a vertex 6");
  expect("1 1 0 0 1 0", "1 1 2 0 1 0", "16: the points are not in one plane");
  expect("1 1 0 0 1 0", "1 1 x 0 1 0", "16: \"x\" is no number of type Float32");
  expect("\n1 0\n", "\n0 0\n", "11: the group \"rock\" has no cells");
  expect("\n3 0\n", "\n3 5\n", "5: the group \"left\" has an edge from vertex 3 to vertex 5");
  expect("\"connectivity\"", "\"corners\"", "20: <Cells> has no array \"connectivity\"");
}

TEST(VtuMesh, FilesThatAreCutShortAreRefused) {
  const std::string whole = encoded_vtu::base64_zlib;
  for (const std::string_view digits : {"AQAAAA", "eJ"}) {
    const std::size_t at = whole.find(digits);
    EXPECT_THROW(read_vtu_mesh(file_of("cut.vtu", std::string(whole).erase(at, 12))), FileError) << digits;
  }
  const auto path = std::filesystem::path(testing::TempDir()) / "cut_appended.vtu";
  MeshFile(named_voronoi()).write(path);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_THROW(read_vtu_mesh(path), FileError);
}

TEST(NamedMesh, NamesTheGroupsThatThereAre) {
  const NamedMesh named = named_voronoi();
  EXPECT_EQ(named.vertices("bottom").size(), named.edges("bottom").size() + 1);
  const std::string message = message_of([&] { (void)named.cells("second"); });
  EXPECT_NE(message.find("\"every third\", \"first\""), std::string::npos) << message;
  NamedMesh misnamed = named;
  misnamed.cell_groups["a<b"] = {1};
  EXPECT_THROW(MeshFile{misnamed}, Error);
}

}  // namespace
