#include <polyfem/core/error.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <algorithm>

using namespace polyfem;

namespace {

TEST(EdgeMidpoints, AreSharedByTheCellsOfAnEdge) {
  const PolygonMesh mesh = voronoi(support::l_shape(), {.n_cells = 40});
  const PolygonMesh quadratic = with_edge_midpoints(mesh);
  EXPECT_TRUE(find_defects(quadratic).empty());
  const auto n_boundary = static_cast<Index>(boundary_edges(mesh).size());
  const auto n_edges = (static_cast<Index>(mesh.indices.size()) + n_boundary) / 2;
  EXPECT_EQ(quadratic.vertices.cols(), mesh.vertices.cols() + n_edges);
  EXPECT_EQ(quadratic.vertices.leftCols(mesh.vertices.cols()), mesh.vertices);
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points corners = mesh.outline(c), nodes = quadratic.outline(c);
    ASSERT_EQ(nodes.cols(), 2 * corners.cols());
    for (Index k = 0; k < corners.cols(); ++k) {
      EXPECT_EQ(Vec2(nodes.col(2 * k)), Vec2(corners.col(k)));
      EXPECT_LT((nodes.col(2 * k + 1) - (corners.col(k) + corners.col((k + 1) % corners.cols())) / 2).norm(),
                1e-15);
    }
  }
}

TEST(EdgeMidpoints, OfTheBoundaryComeWithTheirEdges) {
  const PolygonMesh quadratic = with_edge_midpoints(rectangles({0, 0}, {3, 1}, 3, 2));
  const auto top = quadratic_boundary_edges(quadratic, [](const Vec2& x) { return x.y() == 1; });
  ASSERT_EQ(top.size(), 3u);
  for (const auto& [first, middle, last] : top) {
    EXPECT_EQ(quadratic.vertices(0, first) - 1, quadratic.vertices(0, last)) << "in the cell's direction";
    EXPECT_EQ(quadratic.vertices(0, first) - 0.5, quadratic.vertices(0, middle));
  }
  EXPECT_EQ(quadratic_boundary_edges(quadratic, [](const Vec2&) { return true; }).size(), 10u);
  EXPECT_THROW(quadratic_boundary_edges(triangles({0, 0}, {1, 1}, 1, 1), [](const Vec2&) { return true; }),
               Error);
}

TEST(EdgeMidpoints, AreFoundForEdgesOfTheCoarseMesh) {
  const PolygonMesh mesh = rectangles({0, 0}, {3, 1}, 3, 2), quadratic = with_edge_midpoints(mesh);
  const auto on_top = [](const Vec2& x) { return x.y() == 1; };
  auto found = quadratic_edges(quadratic, boundary_edges(mesh, on_top));
  auto expected = quadratic_boundary_edges(quadratic, on_top);
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
  const std::array turned{expected[0][2], expected[0][0]};
  EXPECT_THROW(quadratic_edges(quadratic, std::span(&turned, 1)), Error);
}

}  // namespace
