/// \file Element matrices of one unknown a vertex: diffusion and mass, n x n; and masses lumped at vertices.
///
/// Results are written into arguments of the right size, which are overwritten and not reallocated.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// Integral of grad N_i . k grad N_j for a symmetric conductivity k, whose upper triangle is read. Symmetric
/// to the last bit; in the unit of k.
void diffusion(const TabulatedElement& element, const Mat2& conductivity, MatrixXd& K);

/// Integral of N_i N_j; each direction of `mass` has this. m^2.
void scalar_mass(const TabulatedElement& element, MatrixXd& M);

/// The area, shared among the vertices, n entries > 0; times the density a mass for each direction. m^2.
///
/// A vertex has the row sum of the consistent mass, the integral of N_i: so the centre of mass is kept. It is
/// positive for every convex polygon, as N_i is. Where one is not (a rule with a negative weight, a deep
/// notch under functions that are negative there) the diagonal of the consistent mass is scaled to the area
/// instead, which keeps the mass but not its centre.
void lumped_mass(const TabulatedElement& element, VectorXd& m);

}  // namespace polyfem
