/// \file A polygon cut into small triangles, to draw what varies inside it.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// Points and triangles of the subdivision.
struct FanSubdivision {
  Points points;                                    ///< those of the outline first
  Eigen::Matrix<int, 3, Eigen::Dynamic> triangles;  ///< three points a column, counter-clockwise
};

/// Each triangle between an edge and `centre` is split into n x n, n >= 1, of its own shape.
///
/// Points lie on n rings, the outline drawn in towards the centre by k/n, with n - k pieces to an edge on
/// ring k.
FanSubdivision subdivide_fan(const PointsRef& outline, const Vec2& centre, int n);

}  // namespace polyfem
