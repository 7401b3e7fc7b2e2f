#include <polyfem/assembly/time_matrices.hpp>

#include <polyfem/core/error.hpp>

namespace polyfem {

TimeMatrices::TimeMatrices(const PolygonMesh& mesh, int n_components, const CellMatrices& cell_matrices,
                           double mass_factor, FieldProblem& effective)
    : stiffness_(mesh, n_components), mass_(mesh, n_components) {
  MatrixXd M;
  effective.assemble([&](int cell, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    cell_matrices(cell, polygon, K, M, f);
    const Index n = n_components * polygon.cols();
    if (f.size() != n || K.rows() != n || K.cols() != n || M.rows() != n || M.cols() != n)
      throw Error("f has " + std::to_string(f.size()) + " rows, K is " + std::to_string(K.rows()) + " x " +
                  std::to_string(K.cols()) + ", M " + std::to_string(M.rows()) + " x " +
                  std::to_string(M.cols()) + ": all need one row for each of the " + std::to_string(n) +
                  " unknowns of cell " + std::to_string(cell));
    stiffness_.add(cell, K);
    mass_.add(cell, M);
    K += mass_factor * M;
  });
  loads_ = effective.loads();
}

VectorXd TimeMatrices::stiffness_times(const VectorXd& u) const {
  return stiffness_.lower().selfadjointView<Eigen::Lower>() * u;
}

VectorXd TimeMatrices::mass_times(const VectorXd& u) const {
  return mass_.lower().selfadjointView<Eigen::Lower>() * u;
}

}  // namespace polyfem
