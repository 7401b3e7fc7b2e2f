#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/gradient_products.hpp>
#include <polyfem/element/matrices.hpp>

#include <Eigen/LU>
#include <algorithm>

namespace polyfem {
namespace {

/// The lambda of the file's head: A is D for strains (theta, eps_xx - eps_yy, gamma_xy).
double dilatational_stiffness(const Mat3& D) {
  Mat3 basis;
  basis << 0.5, 0.5, 0,  //
      0.5, -0.5, 0,      //
      0, 0, 1;
  const Mat3 A = basis.transpose() * D.selfadjointView<Eigen::Upper>() * basis;
  const Mat2 rest = A.bottomRightCorner<2, 2>();
  const Vec2 coupling = A.block<2, 1>(1, 0);
  return std::max(0., A(0, 0) - coupling.dot(rest.inverse() * coupling) - rest.trace() / 2);
}

}  // namespace

void b_bar_stiffness(const TabulatedElement& element, const Mat3& elasticity, MatrixXd& K) {
  const double lambda = dilatational_stiffness(elasticity), factor = lambda / element.area;
  Mat3 rest = elasticity;
  rest.topLeftCorner<2, 2>().array() -= lambda;
  thread_local VectorXd x, y;  // integrals of N_i,x and N_i,y
  x.noalias() = element.dx.transpose() * element.rule.weights;
  y.noalias() = element.dy.transpose() * element.rule.weights;
  K.resize(2 * element.n_vertices(), 2 * element.n_vertices());
  for_each_gradient_product(element, [&](Index i, Index j, const GradientProduct& G) {
    StiffnessBlock block(rest, G);
    block.uu += factor * x[i] * x[j];
    block.uv += factor * x[i] * y[j];
    block.vu += factor * y[i] * x[j];
    block.vv += factor * y[i] * y[j];
    block.put(i, j, K);
  });
}

void b_bar_stresses(const TabulatedElement& element, const Mat3& elasticity,
                    const Eigen::Ref<const VectorXd>& d, Tensors& stress) {
  thread_local Tensors strain;
  strains(element, d, strain);
  const double lambda = dilatational_stiffness(elasticity);
  const auto theta = strain.row(0) + strain.row(1);
  const double mean_theta = theta.dot(element.rule.weights) / element.area;
  Mat3 rest = elasticity.selfadjointView<Eigen::Upper>();
  rest.topLeftCorner<2, 2>().array() -= lambda;
  stress.noalias() = rest * strain;
  stress.topRows<2>().array() += lambda * mean_theta;
}

}  // namespace polyfem
