#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/vertex_averages.hpp>

#include <cassert>
#include <cmath>

namespace polyfem {

MatrixXd vertex_averages(const PolygonMesh& mesh, const Eigen::Ref<const MatrixXd>& at_corners) {
  assert(at_corners.cols() == static_cast<Index>(mesh.indices.size()));
  MatrixXd average = MatrixXd::Zero(at_corners.rows(), mesh.vertices.cols());
  VectorXd area_around = VectorXd::Zero(mesh.vertices.cols());
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const double area = std::abs(signed_area(mesh.outline(c)));
    for (int k = mesh.offsets[c]; k < mesh.offsets[c + 1]; ++k) {
      average.col(mesh.indices[k]) += area * at_corners.col(k);
      area_around[mesh.indices[k]] += area;
    }
  }
  for (Index v = 0; v < average.cols(); ++v)
    if (area_around[v] > 0) average.col(v) /= area_around[v];
  return average;
}

}  // namespace polyfem
