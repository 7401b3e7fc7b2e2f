/// \file A polygon with its element, and the same material as an affine block.
#pragma once

#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/corotation.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/random_polygon.hpp>

#include <numbers>

namespace support {

using namespace polyfem;
using std::numbers::pi;

inline Mat2 turn(double angle) {
  Mat2 R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R;
}

inline const Mat2 quarter = turn(pi / 2);

inline VectorXd stacked(const Points& z) {
  return z.reshaped();
}

inline Vec2 resultant(const VectorXd& f) {
  return f.reshaped(2, f.size() / 2).rowwise().sum();
}

/// About the origin.
inline double moment(const VectorXd& f, const Points& nodes) {
  return f.dot(stacked(quarter * nodes));
}

inline Points random_points(Index m, double size, std::mt19937& random) {
  return size * Points::NullaryExpr(2, m, [&random] { return support::uniform(-1, 1, random); });
}

/// A polygon with its element, and the same material as an affine block with unknowns c, F e1, F e2 about
/// the centroid c.
struct Block {
  Block(const Points& rest, const Mat3& D, const Vec3& initial_stress)
      : polygon(rest),
        size(polygon.colwise().norm().maxCoeff()),
        centre(area_moments(polygon).centroid),
        element(polygon, mean_gradient_weights(polygon), stiffness_of(polygon, D)),
        affine(affine_rest(), affine_weights(), Vec3(1, 0, 0), affine_stiffness(D)),
        initial_force(2 * polygon.cols()),
        affine_initial_force(6) {
    stress_forces(tabulated, initial_stress.replicate(1, tabulated.n_points()), initial_force);
    affine_initial_force << 0, 0, affine_forces(initial_force).tail<4>();
  }

  MatrixXd stiffness_of(const Points& rest, const Mat3& D) {
    tabulate(rest, hammer_rule(4), wachspress, GradientCorrection::on, tabulated);
    MatrixXd K;
    stiffness(tabulated, D, K);
    return K;
  }

  Points affine_rest() const {
    Points rest(2, 3);
    rest << centre, Mat2::Identity();
    return rest;
  }

  static Points affine_weights() {
    Points weights(2, 3);
    weights << Vec2::Zero(), Mat2::Identity();
    return weights;
  }

  MatrixXd affine_stiffness(const Mat3& D) const {
    Eigen::Matrix<double, 3, 6> B = Eigen::Matrix<double, 3, 6>::Zero();
    B(0, 2) = B(1, 5) = B(2, 3) = B(2, 4) = 1;
    return tabulated.area * B.transpose() * D * B;
  }

  /// Nodal forces as forces on c, F e1 and F e2, for y = c + F (Y - centre).
  VectorXd affine_forces(const VectorXd& f) const {
    const Points forces = f.reshaped(2, polygon.cols());
    Points sums(2, 3);
    sums << forces.rowwise().sum(), forces * (polygon.colwise() - centre).transpose();
    return stacked(sums);
  }

  Points polygon;
  double size;
  Vec2 centre;
  TabulatedElement tabulated;
  CorotatedElement element, affine;
  VectorXd initial_force, affine_initial_force;
};

inline Mat3 anisotropic() {
  Mat3 D;
  D << 3, 0.7, 0.2,  //
      0.7, 2, 0.4,   //
      0.2, 0.4, 1;
  return D;
}

}  // namespace support
