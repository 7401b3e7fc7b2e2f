/// \file Quadratic serendipity shape functions of a polygon, made of any barycentric basis.
///
/// A quadratic cell of n corners has 2n nodes in counter-clockwise order, a corner and the middle of the edge
/// after it in turn: columns 0, 2, 4 .. of its points are corners, columns 1, 3, 5 .. midpoints. Edges are
/// straight. `with_edge_midpoints` makes a mesh of such cells.
#pragma once

#include <polyfem/basis/basis.hpp>

namespace polyfem {

/// The corners of a quadratic cell: what its barycentric basis is evaluated on, and what rules are made for.
/// Throws Error when the number of nodes is odd or below six.
Points quadratic_corners(const PointsRef& cell);

/// The 2n shape functions at points of the closed cell, one a column of `points`. Reuses the table's storage.
///
/// With lambda_i the barycentric functions of the corners, the products
///     M_i = lambda_i (lambda_i - lambda_i-1 - lambda_i+1)   at corner i,
///     M_i,i+1 = 4 lambda_i lambda_i+1                       at the middle of the edge from corner i
/// are 1 at their node and 0 at the others, and quadratic along edges. Products of corners that are no
/// neighbours vanish on the boundary; they are shared among the 2n nodes such that quadratic polynomials are
/// reproduced (Rand, Gillette and Bajaj, Math. Comp. 83, 2014). Of all ways to share them, that of the least
/// sum of squares is taken: with Q the six monomials at the nodes (6 x 2n) and p(x) those at a point,
///     N = M + Q^T (Q Q^T)^-1 (p - Q M).
/// The shares sum to those of Rand et al. in the constraints but are no sparse ones; they do not depend on
/// affine maps and exist on concave cells as well, as no conic holds all edges of a polygon. Published error
/// estimates are for convex cells; on concave ones the rates are measured, 3 and 2 (`QuadraticConvergence`).
/// On parallelograms N are the functions of the 8-node quadrilateral, on triangles those of the 6-node
/// triangle.
///
/// Throws Error when the number of nodes is odd or below six, when a midpoint is off the middle of its edge,
/// and what the basis throws.
void evaluate_quadratic(const PointsRef& cell, const Basis& basis, const PointsRef& points,
                        ShapeTable& table);

}  // namespace polyfem
