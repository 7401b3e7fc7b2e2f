/// \file How the integrals over a polygon are taken.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/tabulated_element.hpp>

namespace ddacontact {

/// How the integrals over a block whose vertices are its nodes are taken.
struct Integration {
  const polyfem::TriangleRule* triangle_rule;  ///< of each triangle of the fan; not owned
  polyfem::GradientCorrection correction;
  bool definite = true;  ///< whether it gives the block a stiffness of full rank and a definite mass
};

/// The paper's integration, or, with the correction on, the cheapest rule from there that gives this
/// outline and basis a stiffness of full rank and a definite mass.
Integration choose_integration(const PointsRef& outline, polyfem::GradientCorrection correction,
                               const polyfem::Basis& basis = polyfem::wachspress);

}  // namespace ddacontact
