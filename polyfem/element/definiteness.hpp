/// \file Whether a rule gives an element the properties an exact one has.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// What the eigenvalues of an element's matrices say.
struct Definiteness {
  int zero_modes = 0;          ///< eigenvalues of K within 1e-12 of its largest; a full-rank element has 3
  double least_stiffness = 0;  ///< the smallest of the others over the largest; negative: indefinite
  double least_mass = 0;       ///< the smallest eigenvalue of M over its largest; must be > 0
  bool definite() const { return zero_modes == 3 && least_stiffness > 0 && least_mass > 0; }
};

/// The strain energies u.Ku of an element over those of another one, least and largest of all deformations.
struct EnergyRange {
  double least = 0, largest = 0;
};

/// Compares a stiffness matrix with a reference, both 2n x 2n and zero for the same three rigid motions. Not
/// a number when the reference has other deformations without energy. O(n^3), meant for set-up.
EnergyRange compare_energies(const MatrixXd& stiffness, const MatrixXd& reference);

/// Judges a stiffness (2n x 2n) and a mass matrix by their eigenvalues; O(n^3), meant for set-up.
Definiteness judge(const MatrixXd& stiffness, const MatrixXd& mass);

}  // namespace polyfem
