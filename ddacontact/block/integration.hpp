/// \file Quadrature of a block without a mesh.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/tabulated_element.hpp>

namespace ddacontact {

/// Quadrature of a block whose vertices are its nodes.
struct Integration {
  const polyfem::TriangleRule* triangle_rule;  ///< of each triangle of the fan; not owned
  polyfem::GradientCorrection correction;
  bool definite = true;  ///< whether stiffness has full rank and mass is positive definite
};

/// With the correction off the paper's rule, whatever it gives. With it on the cheapest rule, of at least the
/// paper's degree, by which outline and basis have a stiffness of full rank and a positive definite mass;
/// where there is none the finest, `definite` false.
Integration choose_integration(const PointsRef& outline, polyfem::GradientCorrection correction,
                               const polyfem::Basis& basis = polyfem::wachspress);

}  // namespace ddacontact
