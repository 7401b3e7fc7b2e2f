/// \file Problems solved by deal.II, one thread. Its headers stay in the source file.
#pragma once

#include <tests/performance/work_precision/measurement.hpp>

namespace work_precision {

/// Q1 on quadrilaterals, the same with the volumetric part at one point, Q2 with straight edges, P1 on
/// triangles.
enum class DealIIElement { q1, q1_reduced, q2, p1 };

/// Solves on a mesh of quadrilaterals (of triangles for P1) by deal.II's UMFPACK, by `polyfem::Cholesky`
/// (copying the matrix to it is not counted) and, if asked, by conjugate gradients with SSOR: "umfpack",
/// "cholmod", "cg".
Run run_deal_ii(const Problem& problem, const polyfem::PolygonMesh& mesh, DealIIElement element, bool with_cg,
                bool with_errors = true);

}  // namespace work_precision
