/// \file Forces and tangent of an element under large strains, on its reference shape (total Lagrangian).
#pragma once

#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/material/neo_hooke.hpp>

#include <functional>

namespace polyfem {

/// Stress and tangent at integration point q for a deformation gradient; with the point's number a material
/// finds what the point remembers (`History`).
using FinitePointStress = std::function<FiniteStress(Index q, const Mat2& F)>;

/// With F = 1 + sum_i u_i grad N_i^T at the integration points and displacements d = (u1 v1 u2 v2 ...),
///     forces_i = integral of P grad N_i,      K = d forces / d d,
/// 2n and 2n x 2n, both overwritten. Elements of either order; with the gradient correction on, a uniform
/// deformation has exact forces. Passes on what the material throws.
void finite_strain_forces(const TabulatedElement& element, const FinitePointStress& material,
                          const Eigen::Ref<const VectorXd>& d, MatrixXd& K, VectorXd& forces);

}  // namespace polyfem
