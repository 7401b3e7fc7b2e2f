/// \file The element that a cell has unless one chooses basis, rule and correction.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// `suitable_basis` with corrected gradients: at 2 x 2 Gauss points on a convex quadrilateral, 3 points of
/// degree 2 on a triangle, `dunavant_rule(4)` on the triangles of another cell. The patch test holds to
/// round-off; for errors of the matrices below a bound see `tabulate_to_tolerance`.
void tabulate(const PointsRef& cell, TabulatedElement& element);

/// The same of a quadratic cell, see `evaluate_quadratic`: 3 x 3 Gauss points on a convex quadrilateral,
/// `dunavant_rule(4)` on the triangles of another cell. The quadratic patch test holds to round-off.
void tabulate_quadratic(const PointsRef& cell, TabulatedElement& element);

}  // namespace polyfem
