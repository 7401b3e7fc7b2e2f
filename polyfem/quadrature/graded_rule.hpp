/// \file Quadrature on a polygon that converges fast however short its edges and straight its corners.
///
/// Shape functions vary fast where a singularity of theirs is near, and where singularities may be is known
/// from the polygon. Each rule cuts it into triangles or takes it as a quadrilateral, maps a square on each
/// piece, and along each line of the square takes Gauss points in the variable in which those singularities
/// are far (see `make_graded_gauss_rule`), as many as the remaining distance asks for. All weights are
/// positive, all points inside. `digits` is what the rules converge in: errors fall about as
/// exp(-0.8 digits), and the number of points grows as its square.
#pragma once

#include <polyfem/quadrature/polygon_rule.hpp>

namespace polyfem {

/// For functions on a strictly convex polygon whose poles are those of rational shape functions, outside of
/// its `AdjointBound`: the bilinear image of a square for a quadrilateral, otherwise the fan from the
/// centroid. Errors depend little on the polygon.
void make_adjoint_rule(const PointsRef& polygon, double digits, PolygonRule& rule);

/// For functions that are singular at the vertices, as mean value functions are, whose gradients there depend
/// on the direction. Triangles are collapsed at the vertices: those of the fan (or, when the polygon is not
/// star-shaped about its centroid, of its ears cut at their centroids) halved so that each has one vertex.
void make_vertex_rule(const PointsRef& polygon, double digits, PolygonRule& rule);

}  // namespace polyfem
