#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/vertex_averages.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <algorithm>

using namespace polyfem;

namespace {

TEST(VertexAverages, KeepWhatCellsAgreeOn) {
  const PolygonMesh mesh = voronoi(support::rectangle(2, 1), {.n_cells = 40});
  MatrixXd at_corners(2, mesh.indices.size());
  for (std::size_t k = 0; k < mesh.indices.size(); ++k)
    at_corners.col(static_cast<Index>(k)) = mesh.vertices.col(mesh.indices[k]);
  EXPECT_LT((vertex_averages(mesh, at_corners) - mesh.vertices).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(VertexAverages, WeighByArea) {
  PolygonMesh mesh;
  mesh.vertices.resize(2, 7);            // a unit square, one of 3 x 1 to its right, and a vertex of no cell
  mesh.vertices << 0, 1, 1, 0, 4, 4, 9,  //
      0, 0, 1, 1, 0, 1, 9;
  mesh.add_cell(std::vector{0, 1, 2, 3});
  mesh.add_cell(std::vector{1, 4, 5, 2});
  MatrixXd at_corners(1, 8);
  at_corners << 1, 1, 1, 1, 5, 5, 5, 5;
  Eigen::RowVectorXd expected(7);
  expected << 1, 4, 4, 1, 5, 5, 0;
  EXPECT_LT((vertex_averages(mesh, at_corners) - expected).norm(), 1e-15);
  std::reverse(mesh.indices.begin(), mesh.indices.begin() + 4);
  EXPECT_LT((vertex_averages(mesh, at_corners) - expected).norm(), 1e-15) << "a clockwise cell";
}

}  // namespace
