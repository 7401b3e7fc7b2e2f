#include <tests/support/concave_polygons.hpp>
#include <tests/support/random_shapes.hpp>

#include <ddacontact/block/block_mesh.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

MeshOptions options(CellKind kind, int cells, bool edge_nodes = true) {
  MeshOptions mesh;
  mesh.kind = kind;
  mesh.cells = cells;
  mesh.edge_nodes = edge_nodes;
  return mesh;
}

/// Outlines convex and concave, with vertices on edges, far from the origin.
std::vector<Points> outlines() {
  std::mt19937 random(7);
  std::vector<Points> all;
  for (const support::NamedPolygon& named : support::concave_polygons()) all.push_back(named.points);
  for (int k = 0; k < 30; ++k) all.push_back(support::random_shape(random));
  for (Points& outline : all) outline = (3 * outline).colwise() + Vec2(100, -70);
  return all;
}

Points cell(const BlockMesh& mesh, std::size_t c) {
  return mesh.points(Eigen::all, mesh.cells[c]);
}

TEST(BlockMesh, CellsFillTheOutlineAndKeepItsVertices) {
  for (const Points& outline : outlines())
    for (int cells : {1, 7, 40})
      for (bool edge_nodes : {true, false}) {
        const BlockMesh mesh = divide(outline, options(CellKind::by_shape, cells, edge_nodes));
        double sum = 0;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
          const double area = polyfem::signed_area(cell(mesh, c));
          EXPECT_GT(area, 0);
          sum += area;
        }
        const double area = polyfem::signed_area(outline);
        EXPECT_NEAR(sum, area, 1e-11 * area);
        EXPECT_NEAR(polyfem::signed_area(mesh.points.leftCols(mesh.n_outline)), area, 1e-11 * area);
        ASSERT_EQ(static_cast<Index>(mesh.vertex.size()), outline.cols());
        EXPECT_EQ(mesh.vertex.front(), 0);
        for (Index k = 0; k < outline.cols(); ++k)
          EXPECT_EQ(mesh.points.col(mesh.vertex[static_cast<std::size_t>(k)]), outline.col(k))
              << "to the bit";
        EXPECT_TRUE(std::is_sorted(mesh.vertex.begin(), mesh.vertex.end()));
      }
}

TEST(BlockMesh, WithoutNodesOnEdgesTheOutlineIsThatOfTheBlock) {
  for (const Points& outline : outlines()) {
    const BlockMesh mesh = divide(outline, options(CellKind::voronoi, 30, false));
    EXPECT_EQ(mesh.points.leftCols(mesh.n_outline), outline);
    ASSERT_FALSE(mesh.on_straight_edges.empty());
    for (const BlockMesh::EdgePoint& on : mesh.on_straight_edges) {
      EXPECT_EQ(on.end, (on.start + 1) % mesh.n_outline);
      EXPECT_GT(on.along, 0);
      EXPECT_LT(on.along, 1);
      const Vec2 x = (1 - on.along) * outline.col(on.start) + on.along * outline.col(on.end);
      EXPECT_LE((mesh.points.col(on.point) - x).norm(), 1e-12 * outline.norm());
    }
  }
}

TEST(BlockMesh, QuadsAreAsSquareAsTheyCanBe) {
  const Points bar = support::points({{0, 0}, {8, 0}, {8, 2}, {0, 2}});
  const BlockMesh mesh = divide(bar, options(CellKind::by_shape, 64));
  EXPECT_EQ(mesh.cells.size(), 64u);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    ASSERT_EQ(mesh.cells[c].size(), 4u);
    const Points square = cell(mesh, c);
    for (Index k = 0; k < 4; ++k) EXPECT_NEAR((square.col(k) - square.col((k + 1) % 4)).norm(), 0.5, 1e-12);
  }
  EXPECT_THROW(divide(support::points({{0, 0}, {1, 0}, {0, 1}}), options(CellKind::quads, 4)), Error);
}

TEST(BlockMesh, ACellSizeTakesThePlaceOfANumber) {
  MeshOptions mesh;
  mesh.cells = 3;
  mesh.cell_size = 0.25;
  const Points square = support::points({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  EXPECT_EQ(divide(square, mesh).cells.size(), 64u);
  mesh.cell_size = 1e-4;
  EXPECT_THROW(divide(square, mesh), Error);
}

/// A grid has as many cells along a side whichever vertex comes first.
TEST(BlockMesh, QuadsDoNotDependOnTheNumberingOfTheOutline) {
  for (const double length : {1., 2.5, 12., 100.})
    for (const int cells : {1, 12, 32, 49}) {
      const Points outline = support::points({{0, 0}, {length, 0}, {length, 1}, {0.1, 1}}),
                   next = support::points({{length, 0}, {length, 1}, {0.1, 1}, {0, 0}});
      const BlockMesh one = divide(outline, options(CellKind::quads, cells)),
                      other = divide(next, options(CellKind::quads, cells));
      ASSERT_EQ(one.points.cols(), other.points.cols()) << length << ' ' << cells;
      for (const Vec2& x : one.points.colwise())
        EXPECT_LE((other.points.colwise() - x).colwise().norm().minCoeff(), 1e-14 * length);
    }
}

TEST(BlockMesh, CellsAreSmallWhereTheBlockTouchesOthersAndGrowAwayFromThere) {
  const double fine = 0.02;
  for (const Points& outline : outlines()) {
    MeshOptions mesh_options = options(CellKind::voronoi, 20);
    mesh_options.at_contact = fine;
    const Vec2 touched = outline.col(0);
    const BlockMesh mesh = divide(outline, mesh_options, {touched});
    double sum = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      const Points corners = cell(mesh, c);
      const double area = polyfem::signed_area(corners),
                   distance = (corners.colwise() - touched).colwise().norm().minCoeff();
      EXPECT_LE(std::sqrt(area), fine + distance);
      sum += area;
    }
    EXPECT_NEAR(sum, polyfem::signed_area(outline), 1e-11 * sum);
    EXPECT_LT(mesh.cells.size(), 400u);
  }
}

}  // namespace
