/// \file Quadrature on a polygon: a triangle rule on each of its triangles, Eq. (30).
#pragma once

#include <polyfem/core/types.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/quadrature/gauss_rule.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>

namespace polyfem {

/// Integral of f = sum_q weights[q] f(points.col(q)).
struct PolygonRule {
  Points points;
  VectorXd weights;  ///< sum to the area, those of graded rules to their tolerance
};

/// Whether every triangle (centre, vertex k, vertex k + 1) is counter-clockwise and has an area.
bool is_star_shaped(const PointsRef& polygon, const Vec2& centre);

/// The fan of triangles (centroid, vertex k, vertex k + 1), Figure 2; needs a polygon star-shaped about its
/// centroid, as every convex one is. The centroid is each triangle's first corner. Reuses the rule's storage.
void make_fan_rule(const PointsRef& polygon, const TriangleRule& triangle_rule, PolygonRule& rule);

/// The n - 2 triangles of `triangulate`: any simple polygon. Throws Error when it is not simple.
void make_ear_rule(const PointsRef& polygon, const TriangleRule& triangle_rule, PolygonRule& rule);

/// The same on triangles found before, of this polygon or of one that it has been deformed from.
void make_ear_rule(const PointsRef& polygon, const Triangles& ears, const TriangleRule& triangle_rule,
                   PolygonRule& rule);

/// The fan where the polygon is star-shaped about its centroid, its ears otherwise.
void make_polygon_rule(const PointsRef& polygon, const TriangleRule& triangle_rule, PolygonRule& rule);

/// A rule along edge 0 times one along edge 1 of the square, mapped bilinearly to a convex quadrilateral.
void make_quadrilateral_rule(const PointsRef& quadrilateral, const GaussRule& along_0,
                             const GaussRule& along_1, PolygonRule& rule);

/// n_gauss x n_gauss Gauss points, 1 .. 64: the rule of the isoparametric bilinear element.
void make_quadrilateral_rule(const PointsRef& quadrilateral, int n_gauss, PolygonRule& rule);

}  // namespace polyfem
