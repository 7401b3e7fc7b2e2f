/// \file A compressible Neo-Hookean solid in plane strain: large strains.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// A linear map between 2 x 2 tensors, each read column by column: (xx, yx, xy, yy).
using Mat4 = Eigen::Matrix4d;

/// The first Piola-Kirchhoff stress P and its derivative dP/dF, at a deformation gradient F.
struct FiniteStress {
  Mat2 P;  ///< force per reference area; P n is the traction on the reference normal n. Pa
  Mat4 tangent;
};

/// The energy is W = mu/2 (tr F^T F - 2 - 2 ln J) + lambda/2 (ln J)^2 with J = det F (Bonet and Wood,
/// Eq. 6.27), its derivatives
///     P = mu (F - F^-T) + lambda ln J F^-T,
///     dP_iJ/dF_kL = mu d_ik d_JL + lambda F^-1_Ji F^-1_Lk + (mu - lambda ln J) F^-1_Jk F^-1_Li.
/// At F = 1 it is linear elasticity with Lame's constants. Throws Error unless J > 0.
FiniteStress neo_hooke(double lambda, double mu, const Mat2& F);

/// The derivatives of an energy U(J) that resists a change of volume alone; J is the volume over that before.
struct VolumeStress {
  double stress;   ///< dU/dJ: tension positive, Pa
  double tangent;  ///< d^2U/dJ^2, Pa
};

/// Of the part U = lambda/2 (ln J)^2 of the energy above: `neo_hooke(lambda, mu, F)` has the stress of
/// `neo_hooke(0, mu, F)` plus dU/dJ cof F. Throws Error unless J > 0.
VolumeStress neo_hooke_volume(double lambda, double J);

}  // namespace polyfem
