/// \file Quadrature on a polygon: a triangle rule on each triangle of the fan, Eq. (30).
#pragma once

#include <polyfem/core/types.hpp>
#include <polyfem/quadrature/triangle_rule.hpp>

namespace polyfem {

/// Integral of f = sum_q weights[q] f(points.col(q)).
struct PolygonRule {
  Points points;
  VectorXd weights;  ///< sum to the area
};

/// The fan of triangles (centroid, vertex k, vertex k + 1), Figure 2; needs a polygon star-shaped about its
/// centroid, as every convex one is. The centroid is each triangle's first corner. Reuses the rule's storage.
void make_fan_rule(const PointsRef& polygon, const TriangleRule& triangle_rule, PolygonRule& rule);

}  // namespace polyfem
