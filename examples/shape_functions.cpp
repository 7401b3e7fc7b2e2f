// The shape functions of one polygon and its stiffness matrix.
//
//       4-----3        N_i of Eq. (6) is rational, 1 at vertex i and 0 at the others. What is linear is
//      /       \       reproduced:
//     /         2         sum N_i = 1,   sum N_i x_i = x,   sum grad N_i = 0.
//    /         /       So K = integral of B^T D B, Eq. (17), feels neither translations nor a small rotation
//   0---------1        (three zero modes), and the energy of a uniform strain e is area (e . D e) / 2.
//
// All of it holds to round-off, wherever the polygon lies and with any quadrature, since the gradients are
// corrected so that their integrals are exact.
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/definiteness.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <cmath>
#include <iostream>

using namespace polyfem;

int main() {
  Points polygon(2, 5);
  polygon << 0, 3, 4, 3, 1,  //
      0, 0, 1.5, 3, 3;

  const Vec2 x(1.3, 0.9);
  ShapeValues shape;
  wachspress(polygon, x, shape);
  const double unity = std::abs(shape.values.sum() - 1);
  const double linear = (polygon * shape.values - x).norm();
  const double constant = shape.gradients.rowwise().sum().norm();
  std::cout << "N(" << x.transpose() << ") = " << shape.values.transpose() << "\n|sum N - 1| = " << unity
            << ", |sum N_i x_i - x| = " << linear << ", |sum grad N_i| = " << constant << '\n';

  const Mat3 D = elasticity_matrix(10e9, 0.25, Plane::strain);
  TabulatedElement element;
  MatrixXd K, M;
  tabulate(polygon, dunavant_rule(5), wachspress, GradientCorrection::on, element);
  stiffness(element, D, K);
  mass(element, M);
  const Definiteness definiteness = judge(K, M);
  std::cout << "zero modes of K: " << definiteness.zero_modes << ", the others from "
            << definiteness.least_stiffness << " of the largest\n";

  const Vec3 strain(1e-3, -2e-3, 0.5e-3);  // xx, yy, xy (twice the tensor's)
  Mat2 gradient;
  gradient << strain[0], strain[2] / 2, strain[2] / 2, strain[1];
  const Points u = gradient * polygon;
  const auto d = u.reshaped();  // (u1 v1 u2 v2 ...), Eq. (4)
  const double energy = d.dot(K * d) / 2, exact = element.area * strain.dot(D * strain) / 2;
  std::cout << "energy of a uniform strain: " << energy << " J/m, exactly " << exact << " J/m\n";

  const bool right = unity < 1e-14 && linear < 1e-14 && constant < 1e-14 && definiteness.definite() &&
                     std::abs(energy / exact - 1) < 1e-14;
  return right ? 0 : 1;
}
