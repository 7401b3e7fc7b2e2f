#include <polyfem/element/gradient_products.hpp>
#include <polyfem/element/matrices.hpp>

#include <cassert>

namespace polyfem {

void stiffness(const TabulatedElement& element, const Mat3& elasticity, MatrixXd& K) {
  K.resize(2 * element.n_vertices(), 2 * element.n_vertices());
  for_each_gradient_product(element, [&K, D = elasticity](Index i, Index j, const GradientProduct& G) {
    // B_i^T D B_j with B_i = [N_i,x 0; 0 N_i,y; N_i,y N_i,x]
    const double uu = D(0, 0) * G.xx + D(0, 2) * (G.xy + G.yx) + D(2, 2) * G.yy,
                 vv = D(1, 1) * G.yy + D(1, 2) * (G.xy + G.yx) + D(2, 2) * G.xx,
                 twice = D(0, 2) * G.xx + D(1, 2) * G.yy, uv = D(0, 1) * G.xy + D(2, 2) * G.yx + twice,
                 vu = D(0, 1) * G.yx + D(2, 2) * G.xy + twice;
    K(2 * i, 2 * j) = K(2 * j, 2 * i) = uu;
    K(2 * i, 2 * j + 1) = K(2 * j + 1, 2 * i) = uv;
    K(2 * i + 1, 2 * j) = K(2 * j, 2 * i + 1) = vu;
    K(2 * i + 1, 2 * j + 1) = K(2 * j + 1, 2 * i + 1) = vv;
  });
}

void mass(const TabulatedElement& element, MatrixXd& M) {
  const Index n = element.n_vertices();
  M.setZero(2 * n, 2 * n);
  thread_local VectorXd weighted;
  for (Index j = 0; j < n; ++j) {
    weighted = element.rule.weights.cwiseProduct(element.values.col(j));
    for (Index i = 0; i <= j; ++i) {
      const double integral = element.values.col(i).dot(weighted);
      M(2 * i, 2 * j) = M(2 * i + 1, 2 * j + 1) = integral;
      M(2 * j, 2 * i) = M(2 * j + 1, 2 * i + 1) = integral;
    }
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
