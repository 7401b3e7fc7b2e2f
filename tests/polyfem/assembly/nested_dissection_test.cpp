#include <polyfem/assembly/mesh_matrix.hpp>
#include <polyfem/assembly/nested_dissection.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace polyfem;

namespace {

std::vector<int> order_of(const PolygonMesh& mesh, const std::vector<int>& stage) {
  const MeshMatrix matrix(mesh, 1);
  return minimum_degree_order(matrix.first_neighbours(), matrix.neighbours(), stage);
}

double entries_of_factor(const PolygonMesh& mesh, const std::vector<int>& stage) {
  Cholesky cholesky;
  cholesky.analyze(MeshMatrix(mesh, 1).lower(), order_of(mesh, stage));
  return cholesky.n_factor_entries();
}

PolygonMesh mesh_of(int kind, int n) {
  switch (kind) {
    case 0:
      return rectangles({0, 0}, {1, 1}, n, n);
    case 1:
      return hexagons({0, 0}, {4, 1}, 2 * n, n / 2);
    case 2:
      return voronoi(support::rectangle(2, 1), {.n_cells = n * n});
    default:
      return voronoi(support::star(5), {.n_cells = n * n});
  }
}

class NestedDissection : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Kinds, NestedDissection, testing::Values(0, 1, 2, 3));

TEST_P(NestedDissection, LeavesNoCouplingBetweenVerticesThatNoCutSeparates) {
  const PolygonMesh mesh = mesh_of(GetParam(), 50);
  const std::vector<int> stage = nested_dissection(mesh);
  const int last = *std::max_element(stage.begin(), stage.end());
  EXPECT_GE(last, 6) << "four leaves at least";
  EXPECT_LT(std::count(stage.begin(), stage.end(), last), 200) << "vertices on the first cut";
  // Without those on it, cells of both halves have none in common.
  for (int c = 0; c < mesh.n_cells(); ++c) {
    bool in_first = false, in_second = false;
    for (const int v : mesh.cell(c)) {
      in_first |= stage[v] < last / 2;
      in_second |= stage[v] >= last / 2 && stage[v] < last;
    }
    EXPECT_FALSE(in_first && in_second);
  }
}

TEST_P(NestedDissection, GivesAnOrderThatHasEachVertexOnceStageByStage) {
  for (const int n : {2, 3, 7, 20, 40}) {
    const PolygonMesh mesh = mesh_of(GetParam(), n);
    const std::vector<int> stage = nested_dissection(mesh);
    std::vector<int> order = order_of(mesh, stage), all(order.size());
    EXPECT_TRUE(
        std::is_sorted(order.begin(), order.end(), [&](int v, int w) { return stage[v] < stage[w]; }));
    std::iota(all.begin(), all.end(), 0);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, all);
  }
}

TEST_P(NestedDissection, GivesAFactorNotMuchFullerThanMinimumDegreeAlone) {
  const PolygonMesh mesh = mesh_of(GetParam(), 70);
  const std::vector<int> one_stage(static_cast<std::size_t>(mesh.vertices.cols()), 0);
  EXPECT_LT(entries_of_factor(mesh, nested_dissection(mesh)), 1.2 * entries_of_factor(mesh, one_stage));
}

TEST(NestedDissection, TakesVerticesWithoutCellsAndNoMeshAtAll) {
  PolygonMesh mesh;
  EXPECT_TRUE(nested_dissection(mesh).empty());
  EXPECT_TRUE(order_of(mesh, {}).empty());
  mesh.vertices = Points::Zero(2, 3);
  EXPECT_EQ(nested_dissection(mesh), (std::vector{0, 0, 0}));
}

}  // namespace
