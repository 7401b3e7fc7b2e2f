/// \file Wachspress shape functions of a convex polygon, Eq. (6).
#pragma once

#include <polyfem/basis/shape_values.hpp>

namespace polyfem {

/// Values and gradients at a point of the closed, strictly convex, counter-clockwise polygon.
///
/// With a_k = A(x, v_k, v_k+1) and b_i = A(v_i-1, v_i, v_i+1) the weight of (6) is
///     w_i = b_i prod_{k != i-1, i} a_k = b_i P_{i-1} S_{i+1},   N_i = w_i / sum_j w_j,
/// where P and S are running products from the front and the back. They are carried with their gradients
/// and a common binary exponent apart, so nothing is divided, nothing under- or overflows, and values and
/// gradients are good to round-off on edges and at vertices as inside, at any size and offset, in O(n).
/// At a vertex the gradient is that of the linear triangle of its corner. n = 3 gives the linear triangle.
void wachspress(const PointsRef& polygon, const Vec2& x, ShapeValues& shape);

}  // namespace polyfem
