#include <polyfem/element/diffusion.hpp>
#include <polyfem/element/gradient_products.hpp>
#include <polyfem/element/matrices.hpp>

namespace polyfem {

void diffusion(const TabulatedElement& element, const Mat2& conductivity, MatrixXd& K) {
  K.resize(element.n_vertices(), element.n_vertices());
  for_each_gradient_product(element, [&K, k = conductivity](Index i, Index j, const GradientProduct& G) {
    K(i, j) = K(j, i) = k(0, 0) * G.xx + k(0, 1) * (G.xy + G.yx) + k(1, 1) * G.yy;
  });
}

void scalar_mass(const TabulatedElement& element, MatrixXd& M) {
  M.resize(element.n_vertices(), element.n_vertices());
  thread_local VectorXd weighted;
  for (Index j = 0; j < element.n_vertices(); ++j) {
    weighted = element.rule.weights.cwiseProduct(element.values.col(j));
    for (Index i = 0; i <= j; ++i) M(i, j) = M(j, i) = element.values.col(i).dot(weighted);
  }
}

void lumped_mass(const TabulatedElement& element, VectorXd& m) {
  shape_integrals(element, m);
  if ((m.array() > 0).all()) return;
  m.noalias() = element.values.cwiseAbs2().transpose() * element.rule.weights;
  m *= element.area / m.sum();
}

}  // namespace polyfem
