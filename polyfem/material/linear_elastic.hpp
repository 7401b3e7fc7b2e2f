/// \file Isotropic linear elasticity in the plane; tension positive.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// Which of the out-of-plane components vanish: strains or stresses.
enum class Plane { strain, stress };

/// D of sigma = D epsilon with (xx, yy, xy) components, Eq. (9)-(11) for plane strain. `young` > 0 in Pa,
/// -1 < `poisson` < 1/2; throws Error otherwise.
Mat3 elasticity_matrix(double young, double poisson, Plane plane);

/// Of the stress in the plane; tension positive, Pa.
struct PrincipalStresses {
  double s1 = 0;  ///< the larger one
  double s2 = 0;
  double angle = 0;  ///< direction of s1 from the x axis, radians in (-pi/2, pi/2]
};

/// Eigenvalues and direction of the stress (xx, yy, xy).
PrincipalStresses principal_stresses(const Vec3& stress);

}  // namespace polyfem
