#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/cell_division.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

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

}  // namespace
