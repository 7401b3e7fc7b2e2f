#include <polyfem/element/diffusion.hpp>
#include <polyfem/element/gradient_products.hpp>
#include <polyfem/element/matrices.hpp>

#include <cassert>

namespace polyfem {

void stiffness(const TabulatedElement& element, const Mat3& elasticity, MatrixXd& K) {
  K.resize(2 * element.n_vertices(), 2 * element.n_vertices());
  for_each_gradient_product(element, [&K, D = elasticity](Index i, Index j, const GradientProduct& G) {
    StiffnessBlock(D, G).put(i, j, K);
  });
}

void mass(const TabulatedElement& element, MatrixXd& M) {
  const Index n = element.n_vertices();
  thread_local MatrixXd one_direction;
  scalar_mass(element, one_direction);
  M.setZero(2 * n, 2 * n);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) M(2 * i, 2 * j) = M(2 * i + 1, 2 * j + 1) = one_direction(i, j);
}

void shape_integrals(const TabulatedElement& element, VectorXd& integrals) {
  integrals.noalias() = element.values.transpose() * element.rule.weights;
}

void strains(const TabulatedElement& element, const Eigen::Ref<const VectorXd>& d, Tensors& strain) {
  const Index n = element.n_vertices();
  assert(d.size() == 2 * n);
  strain.resize(3, element.n_points());
  for (Index q = 0; q < element.n_points(); ++q) {
    double xx = 0, yy = 0, xy = 0;
    for (Index i = 0; i < n; ++i) {
      const double dx = element.dx(q, i), dy = element.dy(q, i), u = d[2 * i], v = d[2 * i + 1];
      xx += dx * u;
      yy += dy * v;
      xy += dy * u + dx * v;
    }
    strain.col(q) << xx, yy, xy;
  }
}

void stress_forces(const TabulatedElement& element, const TensorsRef& stress, Eigen::Ref<VectorXd> f) {
  const Index n = element.n_vertices();
  assert(f.size() == 2 * n && stress.cols() == element.n_points());
  f.setZero();
  for (Index q = 0; q < element.n_points(); ++q) {
    const Vec3 force = element.rule.weights[q] * stress.col(q);
    for (Index i = 0; i < n; ++i) {
      const double dx = element.dx(q, i), dy = element.dy(q, i);
      f[2 * i] += dx * force[0] + dy * force[2];
      f[2 * i + 1] += dy * force[1] + dx * force[2];
    }
  }
}

}  // namespace polyfem
