/// \file Displacements that carry a stress given at the integration points.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/element/tabulated_element.hpp>

namespace ddacontact {

/// Displacements w of the vertices (2 x n), next to free of rigid motion, whose strains B(x) w times D are
/// the field nearest in energy to `stress` (3 x q). The element's functions are those of `basis`, whose
/// gradients may have been corrected; K is its stiffness.
Points stress_projection(const polyfem::TabulatedElement& element, const MatrixXd& K,
                         const PointsRef& outline, const Eigen::Ref<const Tensors>& stress,
                         const polyfem::Basis& basis);

}  // namespace ddacontact
