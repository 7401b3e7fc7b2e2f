/// \file Quadratic serendipity shape functions of one cell at its integration points.
///
/// What is made here is a `TabulatedElement` of 2n vertices: stiffness, mass, diffusion, body forces,
/// strains, error norms and `extrapolate_to_vertices` take it as they take elements of first order. Edge
/// loads do not, as they know edges to be linear: see `FieldProblem::add_edge_loads` for edges of three
/// vertices.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// Evaluates `evaluate_quadratic` at the points of a rule for the cell's corners (`quadratic_corners`),
/// reusing the element's storage. Which rule: `dunavant_rule(4)` on triangles of the cell (the overload
/// below) keeps the rates 3 and 2 with the correction on, finer rules gain little; of graded rules the one
/// for the basis (see graded_rule.hpp) where cells have short edges or straight corners.
///
/// The weights are made exact for quadratic polynomials, by the least change: rules of degree 2 have that
/// already, graded ones to their tolerance. At least six points, not on a conic.
///
/// With the correction on, each node's gradients are shifted by a linear function of the place, so that
///     sum_q w_q (q grad N_i + N_i grad q)(x_q)  =  integral over the boundary of q N_i n
/// holds for q = 1, x, y. The right side is exact: along an edge q N_i is cubic, and Simpson's rule gives the
/// edge's 1/6, 4/6 and 1/6 of its length to first, middle and last node. As the rule is exact for degree 2,
/// the shifts leave the gradients of quadratic polynomials as they are. So quadratic displacements with their
/// body force and tractions solve the discrete equations to round-off: the quadratic patch test, whatever the
/// rule. Throws Error for what `evaluate_quadratic` throws.
void tabulate_quadratic(const PointsRef& cell, const PolygonRule& rule, const Basis& basis,
                        GradientCorrection correction, TabulatedElement& element);

/// The same with a triangle rule on each triangle of the cell, see `make_polygon_rule`.
void tabulate_quadratic(const PointsRef& cell, const TriangleRule& triangle_rule, const Basis& basis,
                        GradientCorrection correction, TabulatedElement& element);

}  // namespace polyfem
