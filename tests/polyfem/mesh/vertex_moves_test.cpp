#include <polyfem/core/error.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/vertex_moves.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

class PerturbedMesh : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Amount, PerturbedMesh, testing::Values(0.05, 0.3, 1));

TEST_P(PerturbedMesh, StaysSoundAndKeepsItsBoundary) {
  for (const PolygonMesh& regular :
       {rectangles({0, 0}, {1, 1}, 6, 5), triangles({0, 0}, {1, 1}, 5, 5), hexagons({0, 0}, {2, 1}, 6, 5),
        chevrons({0, 0}, {1, 1}, 5, 5), bricks({0, 0}, {1, 1}, 5, 5)}) {
    PolygonMesh mesh = regular;
    perturb_inner_vertices(mesh, GetParam(), 3);
    EXPECT_NO_THROW(require_valid(mesh));
    for (int c = 0; c < mesh.n_cells(); ++c) {
      if (!find_non_convex_corner(regular.outline(c), 1e-2)) {
        EXPECT_FALSE(find_non_convex_corner(mesh.outline(c), 1e-2));
      }
    }
    const std::vector<int> boundary = boundary_vertices(mesh);
    EXPECT_EQ(mesh.vertices(Eigen::all, boundary), regular.vertices(Eigen::all, boundary));
    const Index n_moved = ((mesh.vertices - regular.vertices).colwise().norm().array() > 0).count();
    EXPECT_GT(n_moved, 0.9 * static_cast<double>(mesh.vertices.cols() - static_cast<Index>(boundary.size())));
  }
}

TEST_P(PerturbedMesh, MovesNoVertexFartherThanItsShortestEdge) {
  const PolygonMesh regular = rectangles({0, 0}, {1, 1}, 10, 10);
  PolygonMesh mesh = regular;
  perturb_inner_vertices(mesh, GetParam());
  const auto moves = (mesh.vertices - regular.vertices).colwise().norm();
  EXPECT_LE(moves.maxCoeff(), GetParam() * 0.1 * (1 + 1e-12));
  EXPECT_GT(moves.maxCoeff(), GetParam() * 0.1 * 0.3);
}

TEST(PerturbedMesh, IsTheSameForTheSameSeed) {
  PolygonMesh first = hexagons({0, 0}, {1, 1}, 4, 4), second = first, other = first;
  perturb_inner_vertices(first, 0.3, 7);
  perturb_inner_vertices(second, 0.3, 7);
  perturb_inner_vertices(other, 0.3, 8);
  EXPECT_EQ(first.vertices, second.vertices);
  EXPECT_NE(first.vertices, other.vertices);
  EXPECT_THROW(perturb_inner_vertices(first, 1.5), Error);
  EXPECT_THROW(perturb_inner_vertices(first, -0.1), Error);
}

TEST(PerturbedMesh, LeavesUnusedVerticesWhereTheyAre) {
  PolygonMesh mesh = rectangles({0, 0}, {1, 1}, 3, 3);
  mesh.vertices.conservativeResize(2, 17);
  mesh.vertices.col(16) << 0.5, 0.5;
  perturb_inner_vertices(mesh, 0.3);
  EXPECT_EQ(mesh.vertices.col(16), Vec2(0.5, 0.5));
}

TEST(MappedMesh, IsCooksPanel) {
  const PolygonMesh panel = mapped(rectangles({0, 0}, {1, 1}, 4, 4), [](const Vec2& x) {
    return Vec2(48 * x.x(), 44 * (x.x() + x.y()) - 28 * x.x() * x.y());
  });
  EXPECT_EQ(panel.vertices.col(4), Vec2(48, 44));
  EXPECT_EQ(panel.vertices.col(24), Vec2(48, 60));
  EXPECT_EQ(panel.vertices.col(20), Vec2(0, 44));
}

TEST(MappedMesh, RefusesAMapThatSpoilsCells) {
  EXPECT_THROW(mapped(rectangles({0, 0}, {1, 1}, 2, 2), [](const Vec2& x) { return Vec2(-x.x(), x.y()); }),
               Error);
}

}  // namespace
