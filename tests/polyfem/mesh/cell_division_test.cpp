#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/cell_division.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace polyfem;

namespace {

TEST(CellDivision, OfAllSquaresGivesTheGridOfHalfTheirSize) {
  const PolygonMesh finer = divide_cells(rectangles({0, 0}, {3, 2}, 3, 2), std::vector<char>(6, 1)),
                    half = rectangles({0, 0}, {3, 2}, 6, 4);
  ASSERT_EQ(finer.n_cells(), half.n_cells());
  EXPECT_EQ(finer.vertices.cols(), half.vertices.cols());
  for (int c = 0; c < finer.n_cells(); ++c) EXPECT_EQ(area_moments(finer.outline(c)).area, 0.25);
}

TEST(CellDivision, KeepsRandomMeshesConformingThroughManyRounds) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    PolygonMesh mesh = voronoi(support::rectangle(2, 1), {.n_cells = 20, .seed = 5u + unsigned(trial)});
    for (int round = 0; round < 4; ++round) {
      std::vector<char> marked(static_cast<std::size_t>(mesh.n_cells()));
      for (char& mark : marked) mark = random() % 4 == 0;
      std::vector<int> first_child;
      const PolygonMesh finer = divide_cells(mesh, marked, &first_child);
      ASSERT_TRUE(find_defects(finer).empty());
      for (int c = 0; c < mesh.n_cells(); ++c) {
        double area = 0;
        const auto position = static_cast<std::size_t>(c);
        for (int part = first_child[position]; part < first_child[position + 1]; ++part)
          area += area_moments(finer.outline(part)).area;
        EXPECT_NEAR(area, area_moments(mesh.outline(c)).area, 1e-15);
      }
      mesh = finer;
    }
  }
}

TEST(CellDivision, RefusesWrongMarksAndCellsThatAreNotSeenWhole) {
  const PolygonMesh mesh = chevrons({0, 0}, {4, 1}, 4, 1, 0.9);
  EXPECT_THROW(divide_cells(mesh, {1}), Error);
  PolygonMesh hook;
  hook.vertices = support::polygon_of({{0, 0}, {4, 0}, {4, 4}, {3.9, 4}, {3.9, 0.1}, {0, 0.1}});
  hook.indices = {0, 1, 2, 3, 4, 5};
  hook.offsets = {0, 6};
  EXPECT_THROW(divide_cells(hook, {1}), Error);
  EXPECT_EQ(divide_cells(hook, {0}).n_cells(), 1);
}

TEST(CellDivision, GroupsGoOn) {
  NamedMesh named{.mesh = rectangles({0, 0}, {3, 2}, 3, 2), .cell_groups = {}, .edge_groups = {}};
  named.cell_groups["lower"] = {0, 1, 2};
  named.edge_groups["bottom"] = boundary_edges(named.mesh, [](const Vec2& x) { return x.y() == 0; });
  named.edge_groups["between"] = {{named.mesh.cell(0)[2], named.mesh.cell(0)[3]}};
  for (const std::vector<char>& marked : {std::vector<char>{1, 0, 0, 0, 0, 1}, std::vector<char>(6, 1)}) {
    const NamedMesh finer = divide_cells(named, marked);
    double area = 0, length = 0;
    for (const int c : finer.cells("lower")) area += signed_area(finer.mesh.outline(c));
    for (const auto& [a, b] : finer.edges("bottom")) {
      EXPECT_GT(finer.mesh.vertices(0, b), finer.mesh.vertices(0, a)) << "the direction of its cell";
      length += finer.mesh.vertices(0, b) - finer.mesh.vertices(0, a);
    }
    EXPECT_NEAR(area, 3, 1e-14);
    EXPECT_NEAR(length, 3, 1e-14);
    EXPECT_EQ(finer.edges("between").size(), 2);
    for (const auto& edge : finer.edges("bottom"))
      EXPECT_TRUE(std::ranges::count(boundary_edges(finer.mesh), edge) == 1);
  }
}

}  // namespace
