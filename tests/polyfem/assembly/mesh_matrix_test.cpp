#include <polyfem/assembly/mesh_matrix.hpp>
#include <polyfem/assembly/pattern_matrix.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <random>

using namespace polyfem;

namespace {

class MeshMatrixOf : public testing::TestWithParam<int> {
 protected:
  const int n_components_ = GetParam();

  MatrixXd random_symmetric(Index n) {
    const MatrixXd values = MatrixXd::NullaryExpr(n, n, [&] { return uniform_(random_); });
    return values + values.transpose();
  }

 private:
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};
INSTANTIATE_TEST_SUITE_P(Components, MeshMatrixOf, testing::Values(1, 2, 3));

TEST_P(MeshMatrixOf, IsTheSumOfItsCells) {
  for (const PolygonMesh& mesh : {voronoi(support::l_shape(), {.n_cells = 60}),
                                  chevrons({0, 0}, {1, 1}, 4, 4), triangles({0, 0}, {1, 1}, 1, 1)}) {
    MeshMatrix matrix(mesh, n_components_);
    PatternMatrix reference;
    Connectivity connectivity;
    for (int c = 0; c < mesh.n_cells(); ++c) {
      std::vector<int> rows;
      for (const int v : mesh.cell(c))
        for (int k = 0; k < n_components_; ++k) rows.push_back(n_components_ * v + k);
      connectivity.append(rows);
    }
    reference.set_connectivity(n_components_ * static_cast<int>(mesh.vertices.cols()), connectivity);
    for (int c = 0; c < mesh.n_cells(); ++c) {
      const MatrixXd K = random_symmetric(n_components_ * static_cast<Index>(mesh.cell(c).size()));
      matrix.add(c, K);
      reference.add(c, K);
    }
    ASSERT_EQ(matrix.lower().nonZeros(), reference.lower().nonZeros());
    EXPECT_TRUE(std::equal(matrix.lower().innerIndexPtr(),
                           matrix.lower().innerIndexPtr() + matrix.lower().nonZeros(),
                           reference.lower().innerIndexPtr()));
    EXPECT_LT((MatrixXd(matrix.lower()) - MatrixXd(reference.lower())).cwiseAbs().maxCoeff(), 1e-14);
    matrix.set_zero();
    EXPECT_EQ(matrix.lower().norm(), 0);
  }
}

}  // namespace
