#include <polyfem/element/definiteness.hpp>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace polyfem {
namespace {

/// Increasing eigenvalues over the one of largest magnitude.
VectorXd relative_eigenvalues(const MatrixXd& symmetric) {
  const VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
  const double largest = eigenvalues.cwiseAbs().maxCoeff();
  return largest > 0 ? VectorXd(eigenvalues / largest) : eigenvalues;
}

}  // namespace

EnergyRange compare_energies(const MatrixXd& stiffness, const MatrixXd& reference) {
  const Index n_deformations = reference.cols() - 3;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(reference);  // rigid motions first
  const MatrixXd of_unit_energy =
      modes.eigenvectors().rightCols(n_deformations) *
      modes.eigenvalues().tail(n_deformations).cwiseSqrt().cwiseInverse().asDiagonal();
  const VectorXd ratios = Eigen::SelfAdjointEigenSolver<MatrixXd>(
                              of_unit_energy.transpose() * stiffness * of_unit_energy, Eigen::EigenvaluesOnly)
                              .eigenvalues();
  return {ratios.minCoeff<Eigen::PropagateNaN>(), ratios.maxCoeff<Eigen::PropagateNaN>()};
}

Definiteness judge(const MatrixXd& stiffness, const MatrixXd& mass) {
  Definiteness definiteness;
  bool first = true;
  for (const double eigenvalue : relative_eigenvalues(stiffness)) {
    if (std::abs(eigenvalue) <= 1e-12) {
      ++definiteness.zero_modes;
    } else if (first) {
      definiteness.least_stiffness = eigenvalue;
      first = false;
    }
  }
  definiteness.least_mass = relative_eigenvalues(mass).minCoeff();
  return definiteness;
}

}  // namespace polyfem
