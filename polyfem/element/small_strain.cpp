#include <polyfem/element/matrices.hpp>
#include <polyfem/element/small_strain.hpp>

namespace polyfem {

void small_strain_forces(const TabulatedElement& element, const PointStress& material,
                         const Eigen::Ref<const VectorXd>& d, MatrixXd& K, VectorXd& forces) {
  const Index n = element.n_vertices();
  Tensors strain, stress(3, element.n_points());
  strains(element, d, strain);
  K.setZero(2 * n, 2 * n);
  MatrixXd B = MatrixXd::Zero(3, 2 * n);
  Mat3 tangent;
  for (Index q = 0; q < element.n_points(); ++q) {
    stress.col(q) = material(q, strain.col(q), tangent);
    for (Index i = 0; i < n; ++i) {
      B(0, 2 * i) = B(2, 2 * i + 1) = element.dx(q, i);
      B(1, 2 * i + 1) = B(2, 2 * i) = element.dy(q, i);
    }
    K.noalias() += B.transpose() * (element.rule.weights[q] * tangent * B);
  }
  forces.resize(2 * n);
  stress_forces(element, stress, forces);
}

}  // namespace polyfem
