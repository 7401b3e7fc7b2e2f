/// \file Element matrices and vectors of the paper's section 3, by the element's own rule.
///
/// The unknowns of an n-gon are d = (u1 v1 u2 v2 ... un vn), Eq. (4); matrices are 2n x 2n in that order.
/// Everything is per unit thickness. Results are written into arguments of the right size, which are
/// overwritten and not reallocated when they already have it.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// K = integral of B^T D B, Eq. (17), of any symmetric D, whose upper triangle is read. N/m per m for D in
/// Pa. Symmetric to the last bit.
void stiffness(const TabulatedElement& element, const Mat3& elasticity, MatrixXd& K);

/// M = integral of N^T N, Eq. (26) without its factor; multiply by the density for a mass. m^2.
void mass(const TabulatedElement& element, MatrixXd& M);

/// Integral of N_i over the element, n entries: (23) is this times the body force. m^2.
void shape_integrals(const TabulatedElement& element, VectorXd& integrals);

/// Strains epsilon = B d at the integration points, Eq. (8).
void strains(const TabulatedElement& element, const Eigen::Ref<const VectorXd>& d, Tensors& strain);

/// f = integral of B^T sigma, 2n entries: the nodal forces that carry the stresses at the integration points
/// (3 x q). (19) is minus this.
void stress_forces(const TabulatedElement& element, const TensorsRef& stress, Eigen::Ref<VectorXd> f);

}  // namespace polyfem
