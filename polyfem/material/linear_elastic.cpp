#include <polyfem/core/error.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace polyfem {

Mat3 elasticity_matrix(double young, double poisson, Plane plane) {
  if (!(young > 0) || !std::isfinite(young))
    throw Error("Young's modulus is " + std::to_string(young) + " Pa but must be positive and finite");
  if (!(poisson > -1 && poisson < 0.5))
    throw Error("Poisson's ratio is " + std::to_string(poisson) + " but must lie between -1 and 1/2");
  const double nu = poisson;
  Mat3 D;
  if (plane == Plane::strain) {
    D << 1 - nu, nu, 0,  //
        nu, 1 - nu, 0,   //
        0, 0, (1 - 2 * nu) / 2;
    return young / ((1 + nu) * (1 - 2 * nu)) * D;
  }
  D << 1, nu, 0,  //
      nu, 1, 0,   //
      0, 0, (1 - nu) / 2;
  return young / (1 - nu * nu) * D;
}

// Mohr's circle: its centre is the mean of xx and yy, the angle of a direction appears doubled.
PrincipalStresses principal_stresses(const Vec3& stress) {
  const double mean = (stress[0] + stress[1]) / 2, half_difference = (stress[0] - stress[1]) / 2;
  const double radius = std::hypot(half_difference, stress[2]);
  const double angle = std::atan2(stress[2], half_difference) / 2;
  return {mean + radius, mean - radius, angle > -std::numbers::pi / 2 ? angle : -angle};
}

}  // namespace polyfem
