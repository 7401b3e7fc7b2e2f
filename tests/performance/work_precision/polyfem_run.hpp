/// \file Problems solved by polyfem, as a user would.
#pragma once

#include <tests/performance/work_precision/measurement.hpp>

namespace work_precision {

/// First order with or without the volumetric strain averaged over each cell, second order, or virtual.
enum class PolyfemElement { plain, b_bar, quadratic, virtual_element };

/// Solves on any mesh, of second order with its edge midpoints added; the time of solving is that of a
/// further right hand side. Errors of virtual elements are those of their projections.
Run run_polyfem(const Problem& problem, const polyfem::PolygonMesh& mesh, PolyfemElement element,
                bool with_errors = true);

}  // namespace work_precision
