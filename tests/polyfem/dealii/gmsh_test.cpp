// What GridIn reads comes through: Gmsh files of both formats in use, with the numbers of their physical
// groups.
#include <polyfem/dealii/triangulation_mesh.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace polyfem;

namespace {

TriangulationMesh read(const char* text) {
  dealii::Triangulation<2> triangulation;
  dealii::GridIn<2> reader(triangulation);
  std::istringstream file(text);
  reader.read_msh(file);
  return polygon_mesh(triangulation);
}

/// Length of the boundary with this number.
double length_of(const TriangulationMesh& mesh, unsigned boundary_id) {
  double length = 0;
  for (const BoundaryLine& line : mesh.boundary)
    if (line.boundary_id == boundary_id)
      length += (mesh.vertices.col(line.vertices[1]) - mesh.vertices.col(line.vertices[0])).norm();
  return length;
}

TEST(Gmsh, QuadrilateralAndTrianglesOfOneFile) {
  // 4-----3-----6   surface 1 is the square, surface 2 the two triangles; line 11 is the left side, 12 the
  // |  1  | 2 / |   right one. Node 7 belongs to nothing.
  // 1-----2-----5
  const TriangulationMesh mesh = read(R"($MeshFormat
2.2 0 8
$EndMeshFormat
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
5
1 1 2 11 1 4 1
2 1 2 12 2 5 6
3 3 2 1 1 1 2 3 4
4 2 2 2 2 2 5 6
5 2 2 2 2 2 6 3
$EndElements
)");
  ASSERT_EQ(mesh.n_cells(), 3);
  EXPECT_EQ(mesh.vertices.cols(), 6);
  EXPECT_EQ(mesh.material_ids, (std::vector<unsigned>{1, 2, 2}));
  EXPECT_EQ(mesh.cell(0).size(), 4u);
  for (int c = 0; c < 3; ++c) EXPECT_DOUBLE_EQ(signed_area(mesh.outline(c)), c == 0 ? 1 : 0.5);
  EXPECT_EQ(mesh.boundary.size(), 6u);
  EXPECT_EQ(boundary_edges(mesh).size(), 6u);
  EXPECT_DOUBLE_EQ(length_of(mesh, 11), 1);
  EXPECT_DOUBLE_EQ(length_of(mesh, 12), 1);
  EXPECT_DOUBLE_EQ(length_of(mesh, 0), 4);
}

TEST(Gmsh, FormatFour) {
  const TriangulationMesh mesh = read(R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 1 1 0
1 0 0 0 2 0 0 1 5 0
1 0 0 0 2 1 0 1 3 0
$EndEntities
$Nodes
1 6 1 6
2 1 0 6
1
2
3
4
5
6
0 0 0
1 0 0
1 1 0
0 1 0
2 0 0
2 1 0
$EndNodes
$Elements
2 4 1 4
1 1 1 2
1 1 2
2 2 5
2 1 3 2
3 1 2 3 4
4 2 5 6 3
$EndElements
)");
  ASSERT_EQ(mesh.n_cells(), 2);
  EXPECT_EQ(mesh.vertices.cols(), 6);
  EXPECT_EQ(mesh.material_ids, (std::vector<unsigned>{3, 3}));
  for (int c = 0; c < 2; ++c) EXPECT_DOUBLE_EQ(signed_area(mesh.outline(c)), 1);
  EXPECT_EQ(boundary_edges(mesh).size(), 6u);
  EXPECT_DOUBLE_EQ(length_of(mesh, 5), 2);
  EXPECT_DOUBLE_EQ(length_of(mesh, 0), 4);
}

}  // namespace
