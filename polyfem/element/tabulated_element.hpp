/// \file Shape functions of one polygon at its integration points.
#pragma once

#include <polyfem/basis/basis.hpp>
#include <polyfem/quadrature/polygon_rule.hpp>

namespace polyfem {

/// Whether the gradients are made to satisfy the discrete divergence theorem, see `tabulate`.
enum class GradientCorrection { off, on };

/// The shape functions of a polygon at the points of a rule.
struct TabulatedElement : ShapeTable {
  PolygonRule rule;  ///< q points and weights, which sum to the area
  double area = 0;   ///< of the polygon
};

/// The integral over the boundary of N_i n, which is that of grad N_i over the polygon: exact, as N_i is
/// linear on edges. Half the chord between the neighbours of vertex i, turned right.
Vec2 boundary_integral(const PointsRef& polygon, Index i);

/// Evaluates the basis at the points of a rule, reusing the element's storage. The basis must be suitable for
/// the polygon (see `require_suitable`).
///
/// The weights are scaled to sum to the polygon's area |E|: rules for functions that are no polynomials, as
/// the graded ones, integrate a constant to their own tolerance only. Their sum must not be 0.
///
/// With the correction on, each node's gradients are shifted by the constant
///     (1/|E|) [ integral over the boundary of N_i n  -  sum_q w_q grad N_i(x_q) ],
/// whose first term is exact because N_i is linear on edges. Then sum_q w_q grad N_i equals that boundary
/// integral for any rule. As sum_i x_i (integral of N_i n)^T = |E| 1 = sum_q w_q 1, the shifts keep
/// sum_i x_i grad N_i^T = 1 at every point, and the patch test holds to round-off. Higher modes are as good
/// as the rule is.
void tabulate(const PointsRef& polygon, const PolygonRule& rule, const Basis& basis,
              GradientCorrection correction, TabulatedElement& element);

/// The same with a triangle rule on each triangle of the polygon, see `make_polygon_rule`.
void tabulate(const PointsRef& polygon, const TriangleRule& triangle_rule, const Basis& basis,
              GradientCorrection correction, TabulatedElement& element);

}  // namespace polyfem
