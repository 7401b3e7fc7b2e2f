/// \file Quadrature on a triangle in area coordinates.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// Integral of f over a triangle of area S = S * sum_q weights[q] f(points.col(q)), Eq. (31).
struct TriangleRule {
  Eigen::Matrix3Xd points;  ///< area coordinates (L1, L2, L3), one point a column
  VectorXd weights;         ///< sum to 1
  int degree = 0;           ///< polynomials up to this degree are integrated exactly

  /// Appends the point (l1, l2, 1 - l1 - l2).
  void add(double l1, double l2, double weight);
};

/// Hammer's symmetric rules: degree 1 (1 point), 2 (3), 3 (4: the paper's (32)), 4 (6), 5 (7). One weight of
/// degree 3 is negative: it makes stiffness and mass indefinite on some concave polygons (26 of 2000 random
/// ones) and is here to compare with the paper; `dunavant_rule` has positive weights alone. Throws Error for
/// another degree.
const TriangleRule& hammer_rule(int degree);

/// Fully symmetric rules with positive weights, so that no energy is negative, and points inside, in the
/// manner of D. A. Dunavant (1985), of degree 6 (12 points), 7 (15), 8 (16), 9 (19), 10 (25), 11 (28), 12
/// (33), 13 (37), 14 (42), 15 (49), 16 (55), 17 (60), 18 (67), 19 (73) and 20 (79); below, Hammer's, for 3
/// the one of degree 4. Throws Error for another degree.
const TriangleRule& dunavant_rule(int degree);

/// Gauss points across (from the first corner to the opposite side) times along that side, collapsed at the
/// first corner. For integrands that vary fast towards the side, `grading` p > 1 clusters the points there:
/// the distance from the corner is s = 1 - (1 - z)^p. Degree: 2 min(across / p, along) - 2, the half rounded
/// up. Throws Error unless 1 <= p <= across and along >= 1.
TriangleRule collapsed_gauss_rule(int across, int along, int grading = 1);

}  // namespace polyfem
