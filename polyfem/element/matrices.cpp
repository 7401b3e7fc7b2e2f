#include <polyfem/element/matrices.hpp>

#include <cassert>

namespace polyfem {

void stiffness(const TabulatedElement& element, const Mat3& elasticity, MatrixXd& K) {
  const Index n = element.n_vertices();
  K.setZero(2 * n, 2 * n);
  for (Index q = 0; q < element.n_points(); ++q) {
    const Mat3 wD = element.rule.weights[q] * elasticity;
    for (Index j = 0; j < n; ++j) {
      const double xj = element.dx(q, j), yj = element.dy(q, j);
      const Vec3 for_u = wD.col(0) * xj + wD.col(2) * yj;  // the two columns of w D B_j
      const Vec3 for_v = wD.col(1) * yj + wD.col(2) * xj;
      for (Index i = 0; i <= j; ++i) {
        const double xi = element.dx(q, i), yi = element.dy(q, i);
        K(2 * i, 2 * j) += xi * for_u[0] + yi * for_u[2];
        K(2 * i + 1, 2 * j) += yi * for_u[1] + xi * for_u[2];
        K(2 * i, 2 * j + 1) += xi * for_v[0] + yi * for_v[2];
        K(2 * i + 1, 2 * j + 1) += yi * for_v[1] + xi * for_v[2];
      }
    }
  }
  K.triangularView<Eigen::StrictlyLower>() = K.transpose();
}

void mass(const TabulatedElement& element, MatrixXd& M) {
  const Index n = element.n_vertices();
  M.setZero(2 * n, 2 * n);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i <= j; ++i) {
      double integral = 0;
      for (Index q = 0; q < element.n_points(); ++q)
        integral += element.rule.weights[q] * element.values(q, i) * element.values(q, j);
      M(2 * i, 2 * j) = M(2 * i + 1, 2 * j + 1) = integral;
      M(2 * j, 2 * i) = M(2 * j + 1, 2 * i + 1) = integral;
    }
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
