#include <polyfem/element/mean_dilatation.hpp>

#include <Eigen/LU>

#include <cassert>

namespace polyfem {

void add_mean_dilatation(const TabulatedElement& element, const VolumeLaw& law,
                         const Eigen::Ref<const VectorXd>& d, MatrixXd& K, VectorXd& forces) {
  const Index n = element.n_vertices();
  assert(d.size() == 2 * n && K.rows() == 2 * n && K.cols() == 2 * n && forces.size() == 2 * n);
  const Points u = d.reshaped(2, n);
  const VectorXd& w = element.rule.weights;
  // The mean J, its gradient g, and its second derivative: dJ = cof F : dF with cof F = (F22 -F21; -F12 F11),
  // and of the vertices i and j, d^2J / du_i dv_j = N_i,x N_j,y - N_i,y N_j,x.
  Mat2 F;
  Points gradients(2, n), g = Points::Zero(2, n);
  double J = 0;
  for (Index q = 0; q < element.n_points(); ++q) {
    gradients << element.dx.row(q), element.dy.row(q);
    F = Mat2::Identity() + u * gradients.transpose();
    Mat2 cofactor;
    cofactor << F(1, 1), -F(1, 0), -F(0, 1), F(0, 0);
    J += w[q] / element.area * F.determinant();
    g += w[q] / element.area * cofactor * gradients;
  }
  const VolumeStress volume = law(J);
  forces += element.area * volume.stress * g.reshaped();
  K += element.area * volume.tangent * g.reshaped() * g.reshaped().transpose();
  const MatrixXd products = element.dx.transpose() * w.asDiagonal() * element.dy;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const double second = volume.stress * (products(i, j) - products(j, i));
      K(2 * i, 2 * j + 1) += second;
      K(2 * j + 1, 2 * i) += second;
    }
}

void add_mean_dilatation(const TabulatedElement& element, double stiffness,
                         const Eigen::Ref<const VectorXd>& d, MatrixXd& K, VectorXd& forces) {
  Points mean_b(2, element.n_vertices());
  mean_b << element.rule.weights.transpose() * element.dx, element.rule.weights.transpose() * element.dy;
  const VectorXd b = mean_b.reshaped() / element.area;
  forces += element.area * stiffness * b.dot(d) * b;
  K += element.area * stiffness * b * b.transpose();
}

}  // namespace polyfem
