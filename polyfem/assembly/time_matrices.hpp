/// \file The matrices of linear problems in time: mass, or capacity, and stiffness, or conductivity.
#pragma once

#include <polyfem/assembly/field_problem.hpp>

#include <functional>

namespace polyfem {

/// Fills the symmetric K and M, and the load f that does not change, of a cell. All come with what the last
/// call left in them, f set to zero in the right size.
using CellMatrices =
    std::function<void(int cell, const PointsRef& polygon, MatrixXd& K, MatrixXd& M, VectorXd& f)>;

/// K and M of a mesh, and the loads of its cells.
class TimeMatrices {
 public:
  /// Assembles K and M, and K + mass_factor M as the matrix of `effective`, a problem on the same mesh.
  /// Throws Error as `FieldProblem::assemble` does.
  TimeMatrices(const PolygonMesh& mesh, int n_components, const CellMatrices& cell_matrices,
               double mass_factor, FieldProblem& effective);

  VectorXd stiffness_times(const VectorXd& u) const;
  VectorXd mass_times(const VectorXd& u) const;
  /// The lower triangles of K and M, with no unknown held: `stiffness().selfadjointView<Eigen::Lower>()`.
  const SparseMatrix& stiffness() const { return stiffness_.lower(); }
  const SparseMatrix& mass() const { return mass_.lower(); }
  /// Loads of cells.
  const VectorXd& loads() const { return loads_; }

 private:
  MeshMatrix stiffness_, mass_;
  VectorXd loads_;
};

}  // namespace polyfem
