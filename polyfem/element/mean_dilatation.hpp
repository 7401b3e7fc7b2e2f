/// \file Mean dilatation for nonlinear materials (B-bar, with large strains as well): elements that do not
/// lock near incompressibility.
///
/// What resists a change of volume is taken out of the material and given the mean of the cell instead of the
/// values at points: one pressure a cell, eliminated (Simo, Taylor and Pister 1985). Forces and tangent of
/// the rest come from `small_strain_forces` or `finite_strain_forces`, those of the mean are added here:
///
///     finite_strain_forces(element, [](Index, const Mat2& F) { return neo_hooke(0, mu, F); }, d, K, forces);
///     add_mean_dilatation(element, [](double J) { return neo_hooke_volume(lambda, J); }, d, K, forces);
///
/// The rest has to resist all strains by itself. To scale whole deformation gradients to the mean volume
/// instead (F-bar, de Souza Neto et al. 1996) would leave quadratic cells, and nearly so polygons of many
/// vertices, with deformations that cost nothing: conformal maps, as z^2 of z = x + iy, change volumes alone.
/// Forces are derivatives of an energy here, so tangents are symmetric. At F = 1 the two lines are
/// `b_bar_stiffness`. Elements of either order; as of B-bar, what is gained is on cells of first order.
#pragma once

#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/material/neo_hooke.hpp>

#include <functional>

namespace polyfem {

/// What resists the change of volume J of an element.
using VolumeLaw = std::function<VolumeStress(double J)>;

/// Adds, for the energy |E| U(J) with the mean J of det F over the element, F = 1 + sum_i u_i grad N_i^T and
/// displacements d = (u1 v1 u2 v2 ...): to forces its gradient, 2n, and to K the derivative of that, 2n x 2n,
/// symmetric. Passes on what the law throws.
void add_mean_dilatation(const TabulatedElement& element, const VolumeLaw& law,
                         const Eigen::Ref<const VectorXd>& d, MatrixXd& K, VectorXd& forces);

/// The same for small strains: the energy |E| stiffness / 2 theta^2 with the mean theta of eps_xx + eps_yy.
/// \param[in] stiffness  Pa; the bulk modulus with `j2_step` of a material with bulk = 0, lambda with one of
///                       2 mu eps
void add_mean_dilatation(const TabulatedElement& element, double stiffness,
                         const Eigen::Ref<const VectorXd>& d, MatrixXd& K, VectorXd& forces);

}  // namespace polyfem
