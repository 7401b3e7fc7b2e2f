/// \file Whether a rule gives an element the properties an exact one has.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// What the eigenvalues of an element's matrices say.
struct Soundness {
  int zero_modes = 0;          ///< eigenvalues of K within 1e-12 of its largest; a sound element has 3
  double least_stiffness = 0;  ///< the smallest of the others over the largest; negative: indefinite
  double least_mass = 0;       ///< the smallest eigenvalue of M over its largest; must be > 0
  bool sound() const { return zero_modes == 3 && least_stiffness > 0 && least_mass > 0; }
};

/// Judges a stiffness (2n x 2n) and a mass matrix by their eigenvalues; O(n^3), meant for set-up.
Soundness judge(const MatrixXd& stiffness, const MatrixXd& mass);

}  // namespace polyfem
