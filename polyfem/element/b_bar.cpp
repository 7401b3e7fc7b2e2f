#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/gradient_products.hpp>
#include <polyfem/element/matrices.hpp>

namespace polyfem {
namespace {

/// P D P: a D that knows nothing of dilatations in the plane.
Mat3 without_dilatation(const Mat3& elasticity) {
  const Vec3 m(1, 1, 0);
  const Mat3 P = Mat3::Identity() - m * m.transpose() / 2;
  const Mat3 D = elasticity.selfadjointView<Eigen::Upper>();
  return P * D * P;
}

}  // namespace

void b_bar_stiffness(const TabulatedElement& element, const Mat3& elasticity, MatrixXd& K) {
  thread_local VectorXd x, y;  // integrals of N_i,x and N_i,y
  x.noalias() = element.dx.transpose() * element.rule.weights;
  y.noalias() = element.dy.transpose() * element.rule.weights;
  K.resize(2 * element.n_vertices(), 2 * element.n_vertices());
  const Mat3 rest = without_dilatation(elasticity);
  for_each_gradient_product(element, [&, D = elasticity](Index i, Index j, const GradientProduct& G) {
    const double a = 1 / element.area;
    const GradientProduct mean{a * x[i] * x[j], a * x[i] * y[j], a * y[i] * x[j], a * y[i] * y[j]};
    const GradientProduct deviation{G.xx - mean.xx, G.xy - mean.xy, G.yx - mean.yx, G.yy - mean.yy};
    (StiffnessBlock(D, mean) += StiffnessBlock(rest, deviation)).put(i, j, K);
  });
}

void b_bar_strains(const TabulatedElement& element, const Eigen::Ref<const VectorXd>& d, Tensors& strain) {
  strains(element, d, strain);
  double mean = 0;
  for (Index q = 0; q < strain.cols(); ++q)
    mean += element.rule.weights[q] * (strain(0, q) + strain(1, q)) / element.area;
  for (Index q = 0; q < strain.cols(); ++q)
    strain.col(q).head<2>().array() += (mean - strain(0, q) - strain(1, q)) / 2;
}

}  // namespace polyfem
