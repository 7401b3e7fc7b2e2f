/// \file Where rational functions on a convex polygon may have their poles.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// A convex region around a strictly convex polygon in which its adjoint has no zero.
///
/// The adjoint (E. L. Wachspress, "A rational finite element basis", 1975) is the polynomial of degree n - 3
/// that vanishes wherever lines of edges meet that are not neighbours; it is the denominator of rational
/// shape functions. It is hyperbolic (K. Kohn et al., "Adjoints and canonical forms of polypols", 2021):
/// along a line through the polygon it has real zeros only, and the part of the plane around the polygon that
/// is free of them is convex. On its border lie the points P_k where the lines of edges k - 1 and k + 1 meet,
/// so the polygon of the P_k, some perhaps at infinity, is the region looked for.
class AdjointBound {
 public:
  /// `polygon` has the origin inside, at a point as well in the middle as its centroid.
  explicit AdjointBound(const PointsRef& polygon);
  /// How far the segment from p to q, in the polygon, can be drawn out beyond q, in units of its length;
  /// between 1e-9 and 1e6.
  double reach(const Vec2& p, const Vec2& q) const;

 private:
  Points sides_;  ///< the line through P_k-1 and P_k is that of the x with sides_.col(k) . x = 1
};

}  // namespace polyfem
