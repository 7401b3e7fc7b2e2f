/// \file Isotropic damage with exponential softening, small strains, alike in tension and compression.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// A material that loses stiffness where it is strained further than ever before. Under uniaxial stress it is
/// elastic up to the strain `onset` and carries
///     E onset exp(-(strain - onset) / softening)
/// beyond, so that its failure costs E onset (onset / 2 + softening) a volume. Strains concentrate in one row
/// of cells: for a fracture energy G_f, N/m, that does not depend on the mesh,
///     softening = G_f / (E onset h) - onset / 2
/// with the cells' width h across the crack (crack band, Bazant and Oh 1983).
struct DamageMaterial {
  Mat3 elasticity;   ///< D of the undamaged material in plane strain or stress, Pa; positive definite
  double young;      ///< E > 0, Pa
  double onset;      ///< > 0
  double softening;  ///< > 0
};

/// Stress, tangent and history at the end of a step.
struct DamageStep {
  Vec3 stress;            ///< xx, yy, xy; tension positive
  Mat3 tangent;           ///< d stress / d strain, symmetric, not definite where the material softens
  double largest_strain;  ///< equivalent strain of the whole history: what a point remembers, 0 at first
  double damage;          ///< in [0, 1): the share of the stiffness that is lost
};

/// The step to a strain (xx, yy, gamma_xy). With the equivalent strain e = sqrt(strain.D strain / E) (energy
/// norm: Simo and Ju 1987, Eq. (2.5)) and its largest value k so far,
///     stress = (1 - damage) D strain,    1 - damage = onset / k exp(-(k - onset) / softening) for k > onset,
/// in closed form. Where e grows beyond k the tangent is
///     (1 - damage) (D - (1 / k + 1 / softening) (D strain)(D strain)^T / (E k)),
/// elsewhere (1 - damage) D.
DamageStep damage_step(const DamageMaterial& material, const Vec3& strain, double largest_strain_before);

}  // namespace polyfem
