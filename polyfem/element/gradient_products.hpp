/// \file Integrals of products of two gradients, from which stiffness matrices of every kind are made.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// The integral of grad N_i grad N_j^T, four numbers.
struct GradientProduct {
  double xx, xy, yx, yy;  ///< of N_i,x N_j,x and so on
};

/// Calls use(i, j, G) for all pairs of vertices i <= j with their gradient product G. Two points at once;
/// `N_POINTS`: their number where it is known.
template <int N_POINTS, typename Use>
[[gnu::always_inline]] inline void for_each_gradient_product_at(const TabulatedElement& element, double* wx,
                                                                double* wy, Use&& use) {
  using Eigen::Array2d;
  using Two = Eigen::Map<const Array2d>;
  const Index n_points = N_POINTS == Eigen::Dynamic ? element.n_points() : N_POINTS,
              n_vertices = element.n_vertices();
  const double *const w = element.rule.weights.data(), *const dx = element.dx.data(),
                      *const dy = element.dy.data();
  for (Index j = 0; j < n_vertices; ++j) {
    for (Index q = 0; q < n_points; ++q) {
      wx[q] = w[q] * dx[j * n_points + q];
      wy[q] = w[q] * dy[j * n_points + q];
    }
    for (Index i = 0; i <= j; ++i) {
      const double *const x = dx + i * n_points, *const y = dy + i * n_points;
      Array2d xx = Array2d::Zero(), xy = xx, yx = xx, yy = xx;
      Index q = 0;
      for (; q + 1 < n_points; q += 2) {
        const Array2d left_x = Two(x + q), left_y = Two(y + q), right_x = Two(wx + q), right_y = Two(wy + q);
        xx += left_x * right_x;
        xy += left_x * right_y;
        yx += left_y * right_x;
        yy += left_y * right_y;
      }
      GradientProduct sum{xx.sum(), xy.sum(), yx.sum(), yy.sum()};
      if (q < n_points) {
        sum.xx += x[q] * wx[q];
        sum.xy += x[q] * wy[q];
        sum.yx += y[q] * wx[q];
        sum.yy += y[q] * wy[q];
      }
      use(i, j, sum);
    }
  }
}

/// Quadrilaterals have four points most often.
template <typename Use>
void for_each_gradient_product(const TabulatedElement& element, Use&& use) {
  constexpr int few = 4;
  if (element.n_points() == few) {
    double wx[few], wy[few];
    for_each_gradient_product_at<few>(element, wx, wy, use);
    return;
  }
  thread_local VectorXd weighted;
  weighted.resize(2 * element.n_points());
  for_each_gradient_product_at<Eigen::Dynamic>(element, weighted.data(), weighted.data() + element.n_points(),
                                               use);
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
