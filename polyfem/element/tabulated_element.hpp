/// \file Shape functions of one polygon at its integration points.
#pragma once

#include <polyfem/basis/shape_values.hpp>
#include <polyfem/quadrature/polygon_rule.hpp>

namespace polyfem {

/// Whether the gradients are made to satisfy the discrete divergence theorem, see `tabulate`.
enum class GradientCorrection { off, on };

/// n shape functions at q integration points of a polygon.
struct TabulatedElement {
  PolygonRule rule;  ///< q points and weights
  MatrixXd values;   ///< N_i(x_q), n x q
  MatrixXd dx, dy;   ///< derivatives of N_i at x_q, n x q
  double area = 0;   ///< the sum of the weights

  Index n_vertices() const { return values.rows(); }
  Index n_points() const { return values.cols(); }
};

/// Evaluates the basis at the points of the fan rule, reusing the element's storage.
///
/// With the correction on, each node's gradients are shifted by the constant
///     (1/|E|) [ integral over the boundary of N_i n  -  sum_q w_q grad N_i(x_q) ],
/// whose first term is exact because N_i is linear on edges. Then sum_q w_q grad N_i equals that boundary
/// integral for any rule, and the patch test holds to round-off. Higher modes are as good as the rule is.
void tabulate(const PointsRef& polygon, const TriangleRule& triangle_rule, Basis basis,
              GradientCorrection correction, TabulatedElement& element);

}  // namespace polyfem
