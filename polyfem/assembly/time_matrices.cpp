#include <polyfem/assembly/time_matrices.hpp>

#include <polyfem/core/error.hpp>

namespace polyfem {

TimeMatrices::TimeMatrices(const PolygonMesh& mesh, int n_components, const CellMatrices& cell_matrices,
                           double mass_factor, FieldProblem& effective)
    : stiffness_(mesh, n_components), mass_(mesh, n_components) {
  MatrixXd M;
  effective.assemble([&](int cell, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    cell_matrices(cell, polygon, K, M, f);
    if (K.rows() != f.size() || K.cols() != f.size() || M.rows() != f.size() || M.cols() != f.size())
      throw Error("K is " + std::to_string(K.rows()) + " x " + std::to_string(K.cols()) + ", M " +
                  std::to_string(M.rows()) + " x " + std::to_string(M.cols()) +
                  ": both need one row for each of " + std::to_string(f.size()) + " unknowns");
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
