#include <polyfem/element/soundness.hpp>

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

Soundness judge(const MatrixXd& stiffness, const MatrixXd& mass) {
  Soundness soundness;
  bool first = true;
  for (const double eigenvalue : relative_eigenvalues(stiffness)) {
    if (std::abs(eigenvalue) <= 1e-12) {
      ++soundness.zero_modes;
    } else if (first) {
      soundness.least_stiffness = eigenvalue;
      first = false;
    }
  }
  soundness.least_mass = relative_eigenvalues(mass).minCoeff();
  return soundness;
}

}  // namespace polyfem
