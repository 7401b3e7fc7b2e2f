#include <polyfem/element/finite_strain.hpp>

#include <cassert>

namespace polyfem {

void finite_strain_forces(const TabulatedElement& element, const FinitePointStress& material,
                          const Eigen::Ref<const VectorXd>& d, MatrixXd& K, VectorXd& forces) {
  const Index n = element.n_vertices();
  assert(d.size() == 2 * n);
  const Points u = d.reshaped(2, n);
  K.setZero(2 * n, 2 * n);
  forces.setZero(2 * n);
  Points gradients(2, n);
  MatrixXd B = MatrixXd::Zero(4, 2 * n);  // of F, read column by column
  for (Index q = 0; q < element.n_points(); ++q) {
    gradients << element.dx.row(q), element.dy.row(q);
    const double weight = element.rule.weights[q];
    const FiniteStress stress = material(q, Mat2::Identity() + u * gradients.transpose());
    forces += weight * (stress.P * gradients).reshaped();
    for (Index i = 0; i < n; ++i)
      for (const int axis : {0, 1})
        for (const int by : {0, 1}) B(2 * by + axis, 2 * i + axis) = gradients(by, i);
    K.noalias() += B.transpose() * (weight * stress.tangent * B);
  }
}

}  // namespace polyfem
