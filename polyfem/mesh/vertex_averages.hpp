/// \file One value a vertex from the values that each cell has there.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

namespace polyfem {

/// Averages over the cells around each vertex, weighted by their areas: k x n_vertices, zero at vertices of
/// no cell. `at_corners` has one column for each entry of mesh.indices, any number k of rows: the values of
/// that cell at that vertex, as stresses extrapolated to it.
MatrixXd vertex_averages(const PolygonMesh& mesh, const Eigen::Ref<const MatrixXd>& at_corners);

}  // namespace polyfem
