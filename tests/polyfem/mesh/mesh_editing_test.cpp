#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/convex_cuts.hpp>
#include <polyfem/mesh/mesh_editor.hpp>
#include <polyfem/mesh/short_edges.hpp>
#include <polyfem/mesh/straight_corners.hpp>
#include <polyfem/mesh/weld.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

PolygonMesh mesh_of(const Points& vertices, std::initializer_list<std::vector<int>> cells) {
  PolygonMesh mesh;
  mesh.vertices = vertices;
  for (const std::vector<int>& cell : cells) mesh.add_cell(cell);
  return mesh;
}

double area(const PolygonMesh& mesh) {
  double sum = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) sum += signed_area(mesh.outline(c));
  return sum;
}

/// A 4 x 2 rectangle in four cells; vertices 8 and 9 are the ends of an inner edge of length 0.1, and
/// vertices 5, 7 lie on the outline. Corners 0 1 2 3 are the domain's.
const Points domain = support::rectangle(4, 2);
PolygonMesh four_cells() {
  const Points vertices = support::polygon_of(
      {{0, 0}, {4, 0}, {4, 2}, {0, 2}, {2, 0}, {4, 1.2}, {2, 2}, {0, 0.8}, {1.95, 1}, {2.05, 1}});
  return mesh_of(vertices, {{0, 4, 9, 8, 7}, {4, 1, 5, 9}, {9, 5, 2, 6, 8}, {8, 6, 3, 7}});
}
MeshEditor editor_of(PolygonMesh mesh) {
  std::vector<BoundaryPosition> positions = boundary_positions(mesh, domain, 1e-9);
  return {mesh, positions, domain};
}

TEST(PolygonMesh, BoundaryEdgesAreThoseOfOneCell) {
  const auto edges = boundary_edges(four_cells());
  EXPECT_EQ(edges.size(), 8u);
  for (const auto& [first, second] : edges) EXPECT_TRUE(first < 8 && second < 8);
  const PolygonMesh overlapping = mesh_of(domain, {{0, 1, 2}, {0, 1, 3}});
  try {
    boundary_edges(overlapping);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("same side of the edge from vertex"), std::string::npos);
  }
  PolygonMesh wrong = four_cells();
  wrong.indices[1] = -1;
  EXPECT_THROW(boundary_edges(wrong), Error);
}

TEST(BoundaryPlaces, TellCornersEdgesAndInside) {
  PolygonMesh mesh = four_cells();
  mesh.vertices(0, 1) += 1e-10;
  const std::vector<BoundaryPosition> positions = boundary_positions(mesh, domain, 1e-9);
  EXPECT_EQ(mesh.vertices(0, 1), 4);
  EXPECT_EQ(positions[2].corner, 2);
  EXPECT_EQ(positions[5].edge, 1);
  EXPECT_EQ(positions[7].edge, 3);
  EXPECT_TRUE(positions[8].inside());
  EXPECT_EQ(common_edge(positions[0], positions[7], 4), 3);
  EXPECT_EQ(common_edge(positions[4], positions[5], 4), std::nullopt);
  EXPECT_EQ(common_edge(positions[0], positions[2], 4), std::nullopt);
}

TEST(BoundaryPlaces, RefusesAMeshThatDoesNotFillTheDomain) {
  PolygonMesh gap = mesh_of(four_cells().vertices, {{0, 4, 9, 8, 7}, {4, 1, 5, 9}, {8, 6, 3, 7}});
  EXPECT_THROW(boundary_positions(gap, domain, 1e-9), Error);
  PolygonMesh hanging = mesh_of(four_cells().vertices, {{0, 4, 6, 3}, {4, 1, 5, 9}, {9, 5, 2, 6}});
  EXPECT_THROW(boundary_positions(hanging, domain, 1e-9), Error);
}

TEST(MeshEditor, CollapsesAnInnerEdge) {
  MeshEditor editor = editor_of(four_cells());
  ASSERT_TRUE(editor.collapse(8, 9, 0.05, false));
  const PolygonMesh mesh = editor.mesh();
  EXPECT_EQ(mesh.n_cells(), 4);
  EXPECT_DOUBLE_EQ(area(mesh), 8);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(mesh.cell(c).size(), 4u);
  EXPECT_EQ(boundary_edges(mesh).size(), 8u);
}

TEST(MeshEditor, KeepsTheOutline) {
  MeshEditor editor = editor_of(four_cells());
  EXPECT_FALSE(editor.collapse(4, 5, 0, true)) << "would cut off a corner";
  EXPECT_FALSE(editor.move(0, Vec2(1, 1)));
  EXPECT_TRUE(editor.collapse(9, 5, 0, true));
  EXPECT_EQ(editor.vertex(9), Vec2(4, 1.2)) << "an inner vertex goes to the outline";
  ASSERT_TRUE(editor.collapse(0, 4, 0, true));
  EXPECT_EQ(editor.vertex(0), Vec2(0, 0)) << "a vertex on an edge goes to the corner";
  EXPECT_FALSE(editor.collapse(0, 1, 0, true)) << "both are corners of the domain";
  EXPECT_DOUBLE_EQ(area(editor.mesh()), 8);
}

TEST(MeshEditor, BreaksNoCell) {
  // With 9 at the place of 5 cell 0 turns by a sine of 0.005 at 8.
  MeshEditor editor = editor_of(four_cells());
  const Points before = editor.mesh().vertices;
  EXPECT_FALSE(editor.collapse(9, 5, 0.05, true));
  EXPECT_EQ(editor.mesh().vertices, before);
  EXPECT_FALSE(editor.move(9, Vec2(0.1, 0.1)));
  EXPECT_FALSE(editor.move(5, Vec2(4, 0.9)));
  EXPECT_EQ(editor.mesh().vertices, before);
  EXPECT_TRUE(editor.collapse(9, 5, 0.004, true));
}

TEST(MeshEditor, LetsATriangleVanishOnlyWhenAllowed) {
  const Points square = support::rectangle(1, 1);
  const Points vertices =
      support::polygon_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}, {0.45, 0.5}, {0.55, 0.5}});
  PolygonMesh mesh = mesh_of(vertices, {{0, 4, 5, 3}, {4, 6, 5}, {4, 1, 2, 6}, {5, 6, 2, 3}});
  const std::vector<BoundaryPosition> positions = boundary_positions(mesh, square, 1e-9);
  MeshEditor editor(mesh, positions, square);
  EXPECT_FALSE(editor.collapse(5, 6, 0, false));
  ASSERT_TRUE(editor.collapse(5, 6, 0, true));
  EXPECT_EQ(editor.mesh().n_cells(), 3);
  EXPECT_DOUBLE_EQ(area(editor.mesh()), 1);
  EXPECT_EQ(boundary_edges(editor.mesh()).size(), 5u);

  MeshEditor enough(mesh, positions, square);
  collapse_short_edges(enough, 0.2, 0.05, 4);
  EXPECT_EQ(enough.mesh().n_cells(), 4);
  collapse_short_edges(enough, 0.2, 0.05, 3);
  EXPECT_EQ(enough.mesh().n_cells(), 3);
}

TEST(BendStraightCorners, RaisesTheTurn) {
  PolygonMesh mesh = four_cells();
  mesh.vertices.col(8) << 1.8, 1;
  mesh.vertices.col(9) << 1.97, 1 + 1e-5;  // cell 2 is nearly straight there
  mesh.vertices.col(5) << 4, 1 + 1e-4;
  MeshEditor editor = editor_of(mesh);
  EXPECT_LT(editor.least_turn_around(9), 1e-3);
  bend_straight_corners(editor, 0.05);
  for (int c = 0; c < 4; ++c) EXPECT_GE(editor.turn(c), 0.05) << c;
  EXPECT_NEAR(area(editor.mesh()), 8, 1e-14);
}

TEST(CutIntoConvex, CutsAlongDiagonalsOnly) {
  const PolygonMesh mesh = mesh_of(support::l_shape(), {{0, 1, 2, 3, 4, 5}});
  const PolygonMesh cut = cut_into_convex(mesh, 1e-3);
  EXPECT_EQ(cut.n_cells(), 2);
  EXPECT_EQ(cut.vertices, mesh.vertices);
  EXPECT_DOUBLE_EQ(area(cut), 3);
}

TEST(CutIntoConvex, MakesConvexCellsOfAnySimplePolygon) {
  const Points spiral = support::polygon_of(
      {{0, 0}, {6, 0}, {6, 6}, {1, 6}, {1, 3}, {3, 3}, {3, 4}, {2, 4}, {2, 5}, {5, 5}, {5, 1}, {0, 1}});
  // The best angles at vertex 0 are those of the diagonal to vertex 5, but a spike stands between them.
  const Points spiked = support::polygon_of(
      {{2, 6}, {2, 4}, {0, 4}, {0, 0}, {10, 0}, {10, 10}, {2.4, 10}, {2.2, 1}, {2.3, 10}, {0, 10}, {0, 6}});
  for (const Points& polygon : {spiral, spiked, support::star(5), support::star(20)}) {
    PolygonMesh mesh;
    mesh.vertices = polygon;
    std::vector<int> corners(polygon.cols());
    for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = static_cast<int>(k);
    mesh.add_cell(corners);
    const PolygonMesh cut = cut_into_convex(mesh, 1e-3);
    for (int c = 0; c < cut.n_cells(); ++c)
      EXPECT_EQ(find_non_convex_corner(cut.outline(c), 1e-3), std::nullopt);
    EXPECT_NEAR(area(cut), signed_area(polygon), 1e-13);
    EXPECT_EQ(boundary_edges(cut).size(), corners.size());
  }
}

TEST(Weld, MakesOneVertexOfCornersThatAgreeToRoundOff) {
  Rings rings;
  const auto add = [&](std::initializer_list<Vec2> points) {
    rings.points.insert(rings.points.end(), points.begin(), points.end());
    rings.offsets.push_back(static_cast<int>(rings.points.size()));
  };
  add({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add({{1 + 1e-15, -1e-15}, {2, 0}, {2, 1}, {1, 1 - 1e-15}});
  add({{-0.0, 1e-15}, {1e-15, 0}, {1e-15, 1e-15}, {0, -1e-15}});  // nothing is left of this one
  const PolygonMesh mesh = weld(rings, 1e-9);
  EXPECT_EQ(mesh.n_cells(), 2);
  EXPECT_EQ(mesh.vertices.cols(), 6);
  EXPECT_EQ(boundary_edges(mesh).size(), 6u);
}

}  // namespace
