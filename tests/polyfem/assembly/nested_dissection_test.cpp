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

/// A positive definite matrix with one unknown a vertex.
SparseMatrix matrix_of(const PolygonMesh& mesh) {
  MeshMatrix matrix(mesh, 1);
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Index n = static_cast<Index>(mesh.cell(c).size());
    matrix.add(c, (1. + static_cast<double>(n)) * MatrixXd::Identity(n, n) - MatrixXd::Ones(n, n));
  }
  return matrix.lower();
}

double entries_of_factor(const SparseMatrix& matrix, const std::vector<int>& order) {
  Cholesky cholesky;
  order.empty() ? cholesky.analyze(matrix) : cholesky.analyze(matrix, order);
  EXPECT_TRUE(cholesky.factorize(matrix));
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

TEST_P(NestedDissection, HasEachVertexOnce) {
  for (const int n : {1, 2, 3, 7, 20}) {
    const PolygonMesh mesh = mesh_of(GetParam(), n + (GetParam() == 1));
    std::vector<int> order = nested_dissection(mesh), all(order.size());
    std::iota(all.begin(), all.end(), 0);
    ASSERT_EQ(static_cast<Index>(order.size()), mesh.vertices.cols());
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, all);
  }
}

TEST_P(NestedDissection, GivesAFactorNearlyAsSparseAsAMinimumDegree) {
  const PolygonMesh mesh = mesh_of(GetParam(), 50);
  const SparseMatrix matrix = matrix_of(mesh);
  EXPECT_LT(entries_of_factor(matrix, nested_dissection(mesh)), 1.5 * entries_of_factor(matrix, {}));
}

TEST(NestedDissection, LetsEntriesGrowLikeNLogN) {
  double previous = 0;
  for (const int n : {16, 32, 64}) {
    const PolygonMesh mesh = rectangles({0, 0}, {1, 1}, n, n);
    const double entries = entries_of_factor(matrix_of(mesh), nested_dissection(mesh));
    if (previous > 0) {
      EXPECT_LT(entries, 5.5 * previous);
    }
    previous = entries;
  }
}

TEST(NestedDissection, TakesVerticesWithoutCellsAndNoMeshAtAll) {
  PolygonMesh mesh;
  EXPECT_TRUE(nested_dissection(mesh).empty());
  mesh.vertices = Points::Zero(2, 3);
  EXPECT_EQ(nested_dissection(mesh).size(), 3u);
}

}  // namespace
