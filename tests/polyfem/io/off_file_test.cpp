#include <polyfem/core/error.hpp>
#include <polyfem/io/off_file.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>
#include <tests/support/text_files.hpp>

#include <gtest/gtest.h>

using namespace polyfem;
using support::file_of, support::message_of;

namespace {

TEST(OffFile, GivesBackTheMeshToTheBit) {
  const auto path = std::filesystem::path(testing::TempDir()) / "off_file_test.off";
  for (const PolygonMesh& mesh :
       {voronoi(support::l_shape(), {.n_cells = 60}), chevrons({0, 0}, {1, 1}, 3, 2)}) {
    write_off(path, mesh);
    const PolygonMesh read = read_off(path);
    EXPECT_EQ(read.vertices, mesh.vertices);
    EXPECT_EQ(read.offsets, mesh.offsets);
    EXPECT_EQ(read.indices, mesh.indices);
  }
}

TEST(OffFile, MayHaveCommentsColoursAndClockwiseFaces) {
  const PolygonMesh mesh = read_off(file_of("colours.off",
                                            "# two faces\nOFF 5 2 0\n\n0 0 3 # at a height\n"
                                            "1 0 3\n1 1 3\n0 1 3\n2 0.5 3\n"
                                            "4 0 1 2 3 255 0 0\n3 1 2 4\n"));
  EXPECT_TRUE(find_defects(mesh).empty());
  EXPECT_EQ(mesh.n_cells(), 2);
  EXPECT_EQ(mesh.vertices.cols(), 5);
}

TEST(OffFile, IsRefusedWithLineAndCure) {
  const auto expect = [](std::string_view text, std::string_view line_and_words) {
    const std::string message = message_of([&] { read_off(file_of("damaged.off", text)); });
    EXPECT_NE(message.find("damaged.off:" + std::string(line_and_words)), std::string::npos) << message;
  };
  expect("NOFF\n", "1: an .off file starts with \"OFF\"");
  expect("OFF\n3 1\n", "2: the line ends too early: give the number of edges");
  expect("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 1\n3 0 1 2\n", "5: vertex 2 is not in the plane");
  expect("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n", "6: face 0 has a vertex 3");
  expect("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n2 0 1\n", "6: \"2\" is no whole number of at least 3");
  expect("OFF\n3 1 0\n0 0 0\n1 0 0\n", "4: the file ends where vertex 2");
  EXPECT_THROW(write_off("/not/there/mesh.off", rectangles({0, 0}, {1, 1}, 1, 1)), FileError);
}

}  // namespace
