/// \file Integrals of products of two gradients, from which stiffness matrices of every kind are made.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// The integral of grad N_i grad N_j^T, four numbers.
struct GradientProduct {
  double xx, xy, yx, yy;  ///< of N_i,x N_j,x and so on
};

/// Sums of products of two columns of x and y components each, two points at once.
[[gnu::always_inline]] inline GradientProduct sum_of_products(const double* ax, const double* ay,
                                                              const double* bx, const double* by,
                                                              Index n_points) {
  using Eigen::Array2d;
  using Two = Eigen::Map<const Array2d>;
  Array2d xx = Array2d::Zero(), xy = xx, yx = xx, yy = xx;
  Index q = 0;
  for (; q + 1 < n_points; q += 2) {
    const Array2d left_x = Two(ax + q), left_y = Two(ay + q), right_x = Two(bx + q), right_y = Two(by + q);
    xx += left_x * right_x;
    xy += left_x * right_y;
    yx += left_y * right_x;
    yy += left_y * right_y;
  }
  GradientProduct sum{xx.sum(), xy.sum(), yx.sum(), yy.sum()};
  if (q < n_points) {
    sum.xx += ax[q] * bx[q];
    sum.xy += ax[q] * by[q];
    sum.yx += ay[q] * bx[q];
    sum.yy += ay[q] * by[q];
  }
  return sum;
}

/// Calls use(i, j, G) for all pairs of vertices i <= j with their gradient product G.
template <typename Use>
void for_each_gradient_product(const TabulatedElement& element, Use&& use) {
  thread_local Eigen::Matrix<double, Eigen::Dynamic, 2> weighted;
  for (Index j = 0; j < element.n_vertices(); ++j) {
    weighted.resize(element.n_points(), 2);
    weighted.col(0) = element.rule.weights.cwiseProduct(element.dx.col(j));
    weighted.col(1) = element.rule.weights.cwiseProduct(element.dy.col(j));
    for (Index i = 0; i <= j; ++i)
      use(i, j,
          sum_of_products(element.dx.col(i).data(), element.dy.col(i).data(), weighted.col(0).data(),
                          weighted.col(1).data(), element.n_points()));
  }
}

/// B_i^T D B_j for B_i = [N_i,x 0; 0 N_i,y; N_i,y N_i,x], D symmetric: what a pair of vertices adds to a
/// stiffness matrix.
struct StiffnessBlock {
  double uu, uv, vu, vv;  ///< rows of vertex i, columns of vertex j

  /// Reads the upper triangle of D.
  StiffnessBlock(const Mat3& D, const GradientProduct& G) {
    const double shear = G.xy + G.yx, both = D(0, 2) * G.xx + D(1, 2) * G.yy;
    uu = D(0, 0) * G.xx + D(0, 2) * shear + D(2, 2) * G.yy;
    uv = D(0, 1) * G.xy + D(2, 2) * G.yx + both;
    vu = D(0, 1) * G.yx + D(2, 2) * G.xy + both;
    vv = D(1, 1) * G.yy + D(1, 2) * shear + D(2, 2) * G.xx;
  }

  /// Writes it to its place in K and to the one across the diagonal.
  void put(Index i, Index j, MatrixXd& K) const {
    K(2 * i, 2 * j) = K(2 * j, 2 * i) = uu;
    K(2 * i, 2 * j + 1) = K(2 * j + 1, 2 * i) = uv;
    K(2 * i + 1, 2 * j) = K(2 * j, 2 * i + 1) = vu;
    K(2 * i + 1, 2 * j + 1) = K(2 * j + 1, 2 * i + 1) = vv;
  }
};

}  // namespace polyfem
