/// \file Mean dilatation (B-bar): elements that do not lock when a material in plane strain is nearly
/// incompressible.
///
/// The dilatation in the plane, theta = eps_xx + eps_yy, is replaced by its mean over the element, half of
/// the difference in each direction:
///     eps_bar = eps + m (mean theta - theta) / 2,   m = (1, 1, 0).
/// As nu tends to 1/2 the bulk modulus then resists one number an element, its change of area, and not one at
/// every point, which a polygon's few unknowns cannot all satisfy but by standing still. With P = 1 - m m^T /
/// 2
///     K_bar = |E| (mean B)^T D (mean B) + integral of (B - mean B)^T P D P (B - mean B).
///
/// Split in three dimensions, theta / 3 would go to each direction, eps_zz included. For an isotropic
/// material the two subtract (lambda + mu) or (lambda + 2 mu / 3) times the integral of (theta - mean
/// theta)^2 from the energy: both take out lambda, which is what locks. Halves need no more than the 3 x 3
/// matrix D, of any material, and stress is D eps_bar.
///
/// Where theta is constant nothing changes: in triangles and in the patch test. In plane stress D is bounded
/// at nu = 1/2 and nothing locks: B-bar converges, to no purpose.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// K_bar, 2n x 2n in the order of `stiffness`, for any symmetric D, whose upper triangle is read.
void b_bar_stiffness(const TabulatedElement& element, const Mat3& elasticity, MatrixXd& K);

/// Strains eps_bar at the integration points, 3 x q: stress is D times these.
void b_bar_strains(const TabulatedElement& element, const Eigen::Ref<const VectorXd>& d, Tensors& strain);

}  // namespace polyfem
