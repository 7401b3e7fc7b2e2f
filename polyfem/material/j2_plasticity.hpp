/// \file Elastoplasticity of von Mises with linear isotropic hardening, in plane strain.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// The material, Pa; shear and bulk modulus above 0, hardening >= 0.
struct J2Material {
  double bulk, shear;
  double yield_stress;   ///< in uniaxial tension, at first
  double hardening = 0;  ///< d yield stress / d equivalent plastic strain
};

/// What a point remembers; all zero at first.
struct PlasticState {
  Eigen::Vector4d strain = Eigen::Vector4d::Zero();  ///< plastic: xx, yy, zz, xy (half of gamma_xy)
  double equivalent = 0;                             ///< the length of its path, times sqrt(2/3)
};

/// Stress, tangent and state at the end of a step.
struct PlasticStep {
  Vec3 stress;  ///< xx, yy, xy
  double stress_zz;
  Mat3 tangent;  ///< d stress / d strain of the algorithm, symmetric
  PlasticState state;
};

/// Backward Euler: radial return (Simo and Hughes, Computational Inelasticity, boxes 3.1 and 3.2) from the
/// state at the start of the step to the strain (xx, yy, gamma_xy) at its end. With s the trial deviator, n =
/// s / |s|,
///     f = |s| - sqrt(2/3) (yield stress),    d_gamma = f / (2 mu + 2/3 H) when f > 0,
/// the deviator is s - 2 mu d_gamma n, and the tangent
///     kappa 1 x 1 + 2 mu theta (I - 1 x 1 / 3) - 2 mu theta_n n x n,
///     theta = 1 - 2 mu d_gamma / |s|,    theta_n = 1 / (1 + H / (3 mu)) - (1 - theta).
PlasticStep j2_step(const J2Material& material, const Vec3& strain, const PlasticState& before);

}  // namespace polyfem
