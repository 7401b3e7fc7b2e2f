/// \file Mean dilatation (B-bar): elements that do not lock when a material in plane strain is nearly
/// incompressible.
///
/// As nu tends to 1/2, lambda grows without bound and its part of the energy, lambda theta^2 / 2 with
/// theta = eps_xx + eps_yy, asks that theta vanish at every point: more than a polygon's few unknowns can do
/// but by standing still. Here theta is replaced in this part by its mean over the element,
///     K_bar = integral of B^T (D - lambda m m^T) B + |E| lambda (mean b)(mean b)^T,   m = (1, 1, 0), b = B^T
///     m, sigma = D eps + lambda m (mean theta - theta),
/// so that lambda resists one number, the element's change of area. It is the mixed method with one pressure
/// an element, eliminated.
///
/// For an isotropic material lambda = D_xxyy, and D - lambda m m^T is 2 mu on normal strains, mu on shear:
/// all strains are still resisted, and there are three zero modes wherever `stiffness` has three. For others
/// it is what remains of the stiffness against dilatation when the mean one against the other strains is
/// taken away, or 0 if that is negative; it does not depend on axes, and D - lambda m m^T is never
/// indefinite.
///
/// Nothing changes where theta is constant, in triangles and in the patch test, nor at nu <= 0. In plane
/// stress D is bounded at nu = 1/2: nothing locks, and these are good elements too.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// K_bar, 2n x 2n in the order of `stiffness`, for a positive definite D, whose upper triangle is read.
/// Symmetric to the last bit.
void b_bar_stiffness(const TabulatedElement& element, const Mat3& elasticity, MatrixXd& K);

/// Stresses at the integration points (3 x q) under displacements d; `stress_forces` of them are K_bar d.
void b_bar_stresses(const TabulatedElement& element, const Mat3& elasticity,
                    const Eigen::Ref<const VectorXd>& d, Tensors& stress);

}  // namespace polyfem
